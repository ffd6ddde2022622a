#pragma once
// Every stage with its parameters: what write_params turns into config/ and docs/parameters.md.
#include <functional>
#include <string>
#include <vector>

#include "field_fusion/core/cloud/cluster.h"
#include "field_fusion/core/cloud/filter.h"
#include "field_fusion/core/cloud/ground.h"
#include "field_fusion/core/detect/yolo_detector.h"
#include "field_fusion/ros/other_names.h"

namespace field_fusion {

/// The filter and the frame in which its boxes stand.
struct FilterStageParams {
  core::FilterParams filter;
  std::string box_frame;

  void declare(core::Params& p) {
    filter.declare(p);
    p.text("box_frame", box_frame, core::When::kStart,
           "Frame of box and body, such as base_link; empty: that of the cloud.");
  }
};

/// The ground finder and the frame that tells what is up.
struct GroundStageParams {
  core::GroundParams ground;
  std::string up_frame;

  void declare(core::Params& p) {
    ground.declare(p);
    p.text("up_frame", up_frame, core::When::kStart,
           "Frame whose z axis is up, such as base_link; empty: that of the cloud.");
  }
};

struct StageDeclaration {
  std::string name;
  /// Calls `use` with the stage's parameters, its own first, then those of every stage, at their defaults.
  std::function<void(const std::function<void(const core::Params&)>& use)> withDefaults;
  OtherNames others;
};

/// In the order of the data flow.
const std::vector<StageDeclaration>& stageDeclarations();

}  // namespace field_fusion
