#pragma once
#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>

#include "field_fusion/core/detect/bearing.h"
#include "field_fusion/core/detect/image_box.h"

namespace field_fusion {

/// A calibrated camera, as its CameraInfo describes it.
class CameraModel {
 public:
  /// Throws std::runtime_error "camera info ...: details" for one that was never calibrated (K = 0), is not
  /// finite, has no size, or a distortion model that image_geometry does not know.
  explicit CameraModel(const sensor_msgs::CameraInfo& info);

  const ros::Time& stamp() const { return stamp_; }
  std::uint32_t width() const { return width_; }    ///< [px]
  std::uint32_t height() const { return height_; }  ///< [px]

  core::Pinhole pinhole() const;
  /// The box through the middles of the rectified edges of `box`, which is in pixels of the image as
  /// received.
  core::ImageBox rectified(const core::ImageBox& box) const;

 private:
  image_geometry::PinholeCameraModel model_;
  ros::Time stamp_;
  std::uint32_t width_, height_;
};

}  // namespace field_fusion
