#pragma once
// World files of a test's own, beside an inertial unit `imu_a` and a scanner `scan_b`.
#include <gtest/gtest.h>

#include <stdexcept>

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/scanner2d.h"
#include "field_fusion/core/sim/world.h"
#include "support/temp_folder.h"

namespace field_fusion::core::sim {

class WorldFile : public testing::Test {
 protected:
  WorldFile() {
    ImuParams imu;
    folder_.write("sensors/imu_a.yaml", "kind: imu\n" + toYaml(declarationOf(imu)));
    Scanner2dParams scan;
    folder_.write("sensors/scan_b.yaml", "kind: scanner2d\n" + toYaml(declarationOf(scan)));
  }
  World load(const std::string& text) const {
    return loadWorld(folder_.write("worlds/w.yaml", text).string());
  }
  /// What loading says; empty when it loads.
  std::string fault(const std::string& text) const {
    try {
      load(text);
      return "";
    } catch (const std::runtime_error& fault) {
      const std::string what = fault.what();
      return what.substr(what.rfind("w.yaml:") + 7);
    }
  }

  test::TempFolder folder_;
};

struct Fault {
  const char* text;
  const char* says;
};

}  // namespace field_fusion::core::sim
