#include "field_fusion/ros/recording.h"

#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>

namespace field_fusion {

Recording::Recording(const std::string& file)
    : file_(file), part_(file + ".part"), bag_(part_, rosbag::bagmode::Write) {
  bag_.setCompression(rosbag::compression::LZ4);  // drawn images shrink twentyfold, others cost little time
}

Recording::~Recording() {
  if (finished_) return;
  bag_.close();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void Recording::writeStatic(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  write("/tf_static", transforms.at(0).header.stamp, message, true);
}

void Recording::finish() {
  bag_.close();
  std::filesystem::rename(part_, file_);
  finished_ = true;
}

geometry_msgs::TransformStamped transformMessage(const ros::Time& stamp, const std::string& parent,
                                                 const std::string& child,
                                                 const core::Transform& T_parent_child) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T_parent_child);
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  return message;
}

sensor_msgs::CameraInfo cameraInfo(const std_msgs::Header& header, const core::Pinhole& camera,
                                   cv::Size image) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(image.width);
  info.height = static_cast<std::uint32_t>(image.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace field_fusion
