#pragma once
#include <camera_info_manager/camera_info_manager.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "field_fusion/ros/camera_model.h"

namespace field_fusion {

/// The calibration of a camera whose driver sends none, from a file as camera_calibration writes it. The
/// service `set_camera_info` of the node handle takes a new one, which holds at once and is saved there.
class CameraFile {
 public:
  /// Throws std::runtime_error "camera_info_url ...: reason" for a URL that is none of file:// and package://,
  /// a file that cannot be read, and a camera that CameraModel refuses.
  CameraFile(const ros::NodeHandle& nh, const std::string& url);

  /// The calibration as the driver would have sent it with this image.
  sensor_msgs::CameraInfo infoFor(const sensor_msgs::Image& image);

 private:
  camera_info_manager::CameraInfoManager manager_;
};

}  // namespace field_fusion
