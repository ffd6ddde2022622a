#include "field_fusion/ros/camera_feed.h"

#include <string>

namespace field_fusion {
namespace {

std::string sizeText(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

bool CameraFeed::readFile(const ros::NodeHandle& nh, const std::string& url) {
  if (!url.empty()) file_ = std::make_unique<CameraFile>(ros::NodeHandle(nh, "camera"), url);
  return file_ != nullptr;
}

void CameraFeed::reset() {
  model_.reset();
  image_stamp_ = ros::Time();
  stamped_alike_ = true;
}

void CameraFeed::add(const sensor_msgs::CameraInfo& info) {
  if (file_) return;
  model_.reset();  // what is refused does not leave the one before in use
  model_ = std::make_shared<const CameraModel>(info);
  if (model_->stamp() == image_stamp_) stamped_alike_ = true;
}

bool CameraFeed::ready(const ros::Time& stamp) const {
  return file_ || (model_ && (model_->stamp() >= stamp || !stamped_alike_));
}

std::shared_ptr<const CameraModel> CameraFeed::modelFor(const sensor_msgs::Image& image, std::string& why) {
  image_stamp_ = image.header.stamp;
  if (file_) model_ = std::make_shared<const CameraModel>(file_->infoFor(image));
  stamped_alike_ =
      model_ && model_->stamp() >= image_stamp_;  // it has waited, and in vain when this is false
  if (!model_) {
    why = "camera info missing";
  } else if (image.width != model_->width() || image.height != model_->height()) {
    why = "camera info is of another size: " + sizeText(model_->width(), model_->height()) +
          " but the image has " + sizeText(image.width, image.height);
  }
  return why.empty() ? model_ : nullptr;
}

}  // namespace field_fusion
