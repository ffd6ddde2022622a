#pragma once
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <memory>
#include <string>

#include "field_fusion/ros/camera_file.h"

namespace field_fusion {

/// Finds the camera model that belongs to an image. Most drivers stamp image and CameraInfo alike: then an
/// image waits for its own, so that a zoom takes effect in time; where they do not, the newest counts.
class CameraFeed {
 public:
  /// From here on the calibration of this file counts and no CameraInfo, where the URL is not empty: then true.
  /// Throws what CameraFile throws; `nh`: below it the service camera/set_camera_info.
  bool readFile(const ros::NodeHandle& nh, const std::string& url);

  /// Throws what CameraModel throws; the model before stays in force.
  void add(const sensor_msgs::CameraInfo& info);

  /// Whether an image of this stamp need not wait any longer.
  bool ready(const ros::Time& stamp) const;

  /// Null, with `why` "camera info missing" or "camera info is of another size: ...", where there is none.
  std::shared_ptr<const CameraModel> modelFor(const sensor_msgs::Image& image, std::string& why);

  void reset();

 private:
  std::unique_ptr<CameraFile> file_;
  std::shared_ptr<const CameraModel> model_;
  ros::Time image_stamp_;
  bool stamped_alike_ = true;
};

}  // namespace field_fusion
