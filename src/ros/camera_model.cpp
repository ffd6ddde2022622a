#include "field_fusion/ros/camera_model.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace field_fusion {
namespace {

template <class Numbers>
bool finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
}

/// Some drivers leave R at zero.
bool isRotation(const boost::array<double, 9>& r) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const double product = r[3 * i] * r[3 * j] + r[3 * i + 1] * r[3 * j + 1] + r[3 * i + 2] * r[3 * j + 2];
      if (std::abs(product - (i == j)) > 1e-3) return false;
    }
  return true;
}

/// Of a lens that lets something be seen: not all the world in one pixel, nor one point in all the image.
bool isPlausible(double focal, double middle, double side) {
  return focal > 1e-3 * side && focal < 1e4 * side && std::abs(middle) < 100.0 * side;
}

void checkPlausible(const char* name, double fx, double cx, double fy, double cy,
                    const sensor_msgs::CameraInfo& info) {
  if (isPlausible(fx, cx, info.width) && isPlausible(fy, cy, info.height)) return;
  std::ostringstream text;
  text << "camera info is not plausible: of an image of " << info.width << "x" << info.height << " pixels, " << name
       << " has focal lengths " << fx << " and " << fy << ", middle " << cx << ", " << cy;
  throw std::runtime_error(text.str());
}

/// The info as image_geometry reads it; throws where it does not describe a camera.
sensor_msgs::CameraInfo checked(sensor_msgs::CameraInfo info) {
  const auto focal = [](double fx, double fy) { return std::to_string(fx) + " and " + std::to_string(fy); };
  if (!finite(info.K) || !finite(info.D) || !finite(info.P) || !finite(info.R))
    throw std::runtime_error("camera info is not finite: K, D, R or P");
  if (!(info.K[0] > 0.0 && info.K[4] > 0.0))
    throw std::runtime_error("camera info is not calibrated: K has focal lengths " +
                             focal(info.K[0], info.K[4]));
  if (!(info.P[0] > 0.0 && info.P[5] > 0.0))
    throw std::runtime_error("camera info is not calibrated: P has focal lengths " +
                             focal(info.P[0], info.P[5]));
  if (info.width == 0 || info.height == 0)
    throw std::runtime_error("camera info has no size: width or height is 0");
  checkPlausible("K", info.K[0], info.K[2], info.K[4], info.K[5], info);
  checkPlausible("P", info.P[0], info.P[2], info.P[5], info.P[6], info);
  // Without distortion image_geometry hands pixels back as they are, so that K describes them and not P; and
  // drivers name such a model as they like.
  if (std::all_of(info.D.begin(), info.D.end(), [](double d) { return d == 0.0; })) {
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0.0);
    info.P = {info.K[0], 0, info.K[2], 0, 0, info.K[4], info.K[5], 0, 0, 0, 1, 0};
  } else if (!isRotation(info.R)) {
    throw std::runtime_error("camera info is not calibrated: R is no rotation (of a single camera it is the identity)");
  }
  return info;
}

/// Size of the image that belongs to the info: its region of interest, binned (REP-104).
std::uint32_t imageSide(std::uint32_t full, std::uint32_t region, std::uint32_t binning) {
  return (region ? region : full) / std::max(1u, binning);
}

}  // namespace

CameraModel::CameraModel(const sensor_msgs::CameraInfo& info)
    : stamp_(info.header.stamp),
      width_(imageSide(info.width, info.roi.width, info.binning_x)),
      height_(imageSide(info.height, info.roi.height, info.binning_y)) {
  const auto understood = checked(info);
  try {
    model_.fromCameraInfo(understood);
    model_.rectifyPoint({0.0, 0.0});  // image_geometry looks at model and D no earlier
  } catch (const std::exception& e) {
    throw std::runtime_error("camera info has a distortion that is not understood: model '" +
                             info.distortion_model + "' with " + std::to_string(info.D.size()) + " numbers");
  }
  const auto at = [this](double x, double y) { return model_.rectifyPoint({x * width_, y * height_}); };
  if (!(at(0.25, 0.5).x < at(0.75, 0.5).x && at(0.5, 0.25).y < at(0.5, 0.75).y))
    throw std::runtime_error("camera info has a distortion that turns the image inside out: D, K, R and P do not belong together");
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
