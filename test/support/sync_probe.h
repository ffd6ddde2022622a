#pragma once
// Feeds a synchroniser with messages that hold nothing but their stamps.
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include <optional>
#include <vector>

#include "field_fusion/core/match/sync.h"

namespace field_fusion::core {

/// What came out: the stamp of a frame and that of each camera's detections, NaN for none.
struct SyncOut {
  double stamp;
  std::vector<double> detections;
  bool clusters;
};

class SyncProbe : public testing::Test {
 protected:
  bool clusters(double stamp, double now) {
    return sync().addClusters(stamp, now, boost::make_shared<double>(stamp));
  }
  bool detections(double stamp, double now, std::size_t camera = 0) {
    return sync().addDetections(camera, stamp, now, boost::make_shared<double>(stamp));
  }
  std::vector<SyncOut> frames(double now) {
    std::vector<SyncOut> out;
    while (const auto frame = sync().next(now)) {
      out.push_back({frame->stamp, {}, frame->clusters != nullptr});
      for (const auto& answer : frame->answers)
        out.back().detections.push_back(
            answer.detections ? *boost::static_pointer_cast<const double>(answer.detections) : double(kNaN));
    }
    return out;
  }
  /// The stamps of frames, negative where the first camera has no part.
  std::vector<double> out(double now) {
    std::vector<double> stamps;
    for (const SyncOut& frame : frames(now))
      stamps.push_back(std::isnan(frame.detections[0]) ? -frame.stamp : frame.stamp);
    return stamps;
  }
  /// A camera at 30 Hz before the clusters of 10.0, from wall time 0 on.
  void learn() {
    for (int i = 30; i > 0; --i) detections(10.0 - i / 30.0, 0.0);
  }
  Sync& sync() {
    if (!sync_) sync_.emplace(params_);
    return *sync_;
  }

  SyncParams params_;  // max_interval 0.05 s, partner_timeout 0.5 s
  std::optional<Sync> sync_;
};

using Stamps = std::vector<double>;

}  // namespace field_fusion::core
