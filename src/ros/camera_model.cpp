#include "field_fusion/ros/camera_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace field_fusion {
namespace {

template <class Numbers>
bool finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
}

const sensor_msgs::CameraInfo& checked(const sensor_msgs::CameraInfo& info) {
  if (!finite(info.K) || !finite(info.D) || !finite(info.P) || !finite(info.R))
    throw std::runtime_error("camera info is not finite: K, D, R or P");
  if (!(info.K[0] > 0.0 && info.K[4] > 0.0))
    throw std::runtime_error("camera info is not calibrated: K has focal lengths " +
                             std::to_string(info.K[0]) + " and " + std::to_string(info.K[4]));
  if (!(info.P[0] > 0.0 && info.P[5] > 0.0))
    throw std::runtime_error("camera info is not calibrated: P has focal lengths " +
                             std::to_string(info.P[0]) + " and " + std::to_string(info.P[5]));
  if (info.width == 0 || info.height == 0)
    throw std::runtime_error("camera info has no size: width or height is 0");
  return info;
}

}  // namespace

CameraModel::CameraModel(const sensor_msgs::CameraInfo& info)
    : stamp_(info.header.stamp), width_(info.width), height_(info.height) {
  try {
    model_.fromCameraInfo(checked(info));
  } catch (const std::runtime_error&) {
    throw;
  } catch (const std::exception& e) {
    throw std::runtime_error(std::string("camera info is not understood: ") + e.what());
  }
}

core::Pinhole CameraModel::pinhole() const { return {model_.fx(), model_.fy(), model_.cx(), model_.cy()}; }

core::ImageBox CameraModel::rectified(const core::ImageBox& box) const {
  // a box has (0, 0) at the outer corner of the first pixel, a camera model at its middle
  const auto at = [this](float x, float y) { return model_.rectifyPoint(cv::Point2d(x - 0.5, y - 0.5)); };
  const auto middle = box.centre();
  return {static_cast<float>(at(box.x_min, middle.y).x), static_cast<float>(at(middle.x, box.y_min).y),
          static_cast<float>(at(box.x_max, middle.y).x), static_cast<float>(at(middle.x, box.y_max).y)};
}

}  // namespace field_fusion
