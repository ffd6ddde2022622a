#pragma once
#include <std_msgs/Header.h>

#include <string>

#include "field_fusion/GroundPlane.h"
#include "field_fusion/core/cloud/plane.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

/// Carries the newest ground plane into the frame of an image.
class GroundFeed {
 public:
  void add(const GroundPlane::ConstPtr& plane) { plane_ = plane; }

  /// In frame and at stamp of the image. All NaN where no plane was found, or its stamp is more than
  /// `max_age` [s] from the image's; and, with `why`, where a transform is missing.
  core::Plane planeFor(const std_msgs::Header& image, const TfCache& tf, double max_age,
                       std::string& why) const;

  void reset() { plane_.reset(); }

 private:
  GroundPlane::ConstPtr plane_;
};

/// The plane in a frame into which `T_target_source` carries its own.
core::Plane carried(const core::Plane& plane, const core::Transform& T_target_source);

}  // namespace field_fusion
