#include "field_fusion/ros/recording.h"

#include <fcntl.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>

namespace field_fusion {
namespace {

// The name is given at the end, perhaps hours later; and a device would be replaced by the bag.
const std::string& fitName(const std::string& file) {
  if (file.empty()) throw std::runtime_error("the bag has no name");
  const auto status = std::filesystem::status(file);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::runtime_error(file + ": is there and is not a plain file");
  return file;
}

/// Makes FILE.part, or FILE.2.part ... where others write the same bag.
std::string ownPart(const std::string& file) {
  for (int n = 1;; ++n) {
    const std::string part = file + (n == 1 ? "" : "." + std::to_string(n)) + ".part";
    const int made = ::open(part.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (made >= 0) ::close(made);
    if (made >= 0 || errno != EEXIST) return part;  // any other fault the bag tells with its name
  }
}

std::unique_ptr<rosbag::Bag> opened(const std::string& part) try {
  return std::make_unique<rosbag::Bag>(part, rosbag::bagmode::Write);
} catch (const rosbag::BagException&) {
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw;
}

}  // namespace

Recording::Recording(const std::string& file)
    : file_(fitName(file)), part_(ownPart(file)), bag_(opened(part_)) {
  bag_->setCompression(rosbag::compression::LZ4);  // drawn images shrink twentyfold, others cost little time
}

Recording::~Recording() {
  if (finished_) return;
  try {
    bag_->close();
  } catch (const std::exception&) {  // a full disk; the bag's own destructor would try again and end the program
    static_cast<void>(bag_.release());
  }
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void Recording::writeStatic(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  write("/tf_static", transforms.at(0).header.stamp, message, true);
}

void Recording::finish() {
  bag_->close();
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
