#include "field_fusion/ros/camera_file.h"

#include <stdexcept>

namespace field_fusion {

CameraFile::CameraFile(const ros::NodeHandle& nh, const std::string& url) : manager_(nh, "camera", url) {
  const auto refuse = [&url](const std::string& reason) {
    throw std::runtime_error("camera_info_url " + url + ": " + reason);
  };
  if (!manager_.validateURL(url)) refuse("must be file:///PATH or package://PACKAGE/PATH of a .yaml or .ini file");
  if (!manager_.loadCameraInfo(url)) refuse("no calibration can be read from it");
  try {
    CameraModel(manager_.getCameraInfo());
  } catch (const std::exception& fault) {
    refuse(fault.what());
  }
}

sensor_msgs::CameraInfo CameraFile::infoFor(const sensor_msgs::Image& image) {
  sensor_msgs::CameraInfo info = manager_.getCameraInfo();
  info.header = image.header;
  return info;
}

}  // namespace field_fusion
