#include "field_fusion/ros/detection.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>

#include "field_fusion/core/detect/ground_range.h"

namespace field_fusion {
namespace {

namespace encoding = sensor_msgs::image_encodings;

geometry_msgs::Vector3 vectorMessage(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 out;
  out.x = v.x();
  out.y = v.y();
  out.z = v.z();
  return out;
}

void setBearingAndRange(ImageDetection& out, const core::Detection& detection, double input_scale,
                        const CameraModel& camera, const core::Plane& ground,
                        const core::RangeParams& params) {
  const auto pinhole = camera.pinhole();
  const auto box = camera.rectified(detection.box);
  const auto middle = box.centre();
  const auto bearing = core::bearing({middle.x, middle.y}, pinhole);
  out.ray = vectorMessage(bearing.ray);
  out.ray_min = vectorMessage(core::bearing({box.x_min, box.y_min}, pinhole).ray);
  out.ray_max = vectorMessage(core::bearing({box.x_max, box.y_max}, pinhole).ray);
  out.azimuth = static_cast<float>(bearing.azimuth);
  out.elevation = static_cast<float>(bearing.elevation);
  const auto by_height = core::rangeFromHeight(out.label, box, detection.cut, input_scale, pinhole, params);
  const auto by_ground = core::rangeFromGround(box, detection.cut, input_scale, pinhole, ground, params);
  const auto range = core::combined(by_height, by_ground);
  out.depth = static_cast<float>(range.depth);
  out.range = static_cast<float>(range.range);
  out.range_sigma = static_cast<float>(range.sigma);
  if (std::isfinite(by_height.range)) out.range_source |= ImageDetection::RANGE_FROM_HEIGHT;
  if (std::isfinite(by_ground.range)) out.range_source |= ImageDetection::RANGE_FROM_GROUND;
}
static_assert((ImageDetection::RANGE_FROM_HEIGHT | ImageDetection::RANGE_FROM_GROUND) ==
              ImageDetection::RANGE_FROM_BOTH);

ImageDetection unknownInSpace() {
  ImageDetection out;
  out.ray = out.ray_min = out.ray_max = vectorMessage(Eigen::Vector3d::Constant(core::kNaN));
  out.azimuth = out.elevation = out.depth = out.range = out.range_sigma = core::kNaN;
  return out;
}

std::string labelText(const ImageDetection& d) {
  const auto number = [](double value, int digits) { return cv::format("%.*f", digits, value); };
  auto text = d.label + " " + number(d.score, 2);
  if (std::isfinite(d.range)) text += "  " + number(d.range, 1) + " m";
  if (std::isfinite(d.azimuth)) text += "  " + number(core::degrees(d.azimuth), 1) + " deg";
  return text;
}

/// Where a label of this size goes: above its box, then ever higher until it covers no other; inside the
/// image.
cv::Rect labelPlace(const ImageDetection& d, cv::Size label, cv::Size image,
                    const std::vector<cv::Rect>& taken) {
  const int left = std::max(0, std::min(static_cast<int>(d.x_min), image.width - label.width));
  cv::Rect place({left, std::max(0, static_cast<int>(d.y_min) - label.height)}, label);
  const auto covers = [&](const cv::Rect& other) { return (place & other).area() > 0; };
  while (place.y > 0 && std::any_of(taken.begin(), taken.end(), covers)) --place.y;
  return place;
}

void drawLabel(cv::Mat& image, const ImageDetection& d, std::vector<cv::Rect>& taken) {
  const double scale =
      std::max(0.4, image.cols / 1600.0);  // legible when the image fills a third of a screen
  const auto text = labelText(d);
  int baseline = 0;
  const auto size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &baseline);
  const auto place = labelPlace(d, {size.width, size.height + baseline}, image.size(), taken);
  taken.push_back(place);
  cv::rectangle(image, place, {40, 25, 0}, cv::FILLED);
  cv::putText(image, text, {place.x, place.y + size.height + baseline / 2}, cv::FONT_HERSHEY_SIMPLEX, scale,
              {255, 255, 255}, 1, cv::LINE_AA);
}

void draw(cv::Mat& image, const ImageDetectionArray& detections) {
  const int thick = std::max(1, image.cols / 600);
  for (const auto& d : detections.detections)
    cv::rectangle(image, cv::Point2f(d.x_min, d.y_min), cv::Point2f(d.x_max, d.y_max), {255, 160, 0}, thick);
  std::vector<cv::Rect> taken;
  for (const auto& d : detections.detections) drawLabel(image, d, taken);
}

}  // namespace

ImageView viewOf(const sensor_msgs::Image::ConstPtr& image) try {
  const auto& e = image->encoding;
  const bool native = e == encoding::BGR8 || e == encoding::RGB8 || e == encoding::MONO8;
  const auto shared = cv_bridge::toCvShare(image, native ? "" : encoding::BGR8);
  if (shared->image.empty()) throw std::runtime_error("0 x 0 pixels");
  return {shared->image, e == encoding::RGB8 ? core::PixelOrder::kRgb : core::PixelOrder::kBgr};
} catch (const std::exception& e) {
  throw std::runtime_error("image cannot be read: encoding '" + image->encoding + "', " +
                           std::to_string(image->width) + "x" + std::to_string(image->height) + ", step " +
                           std::to_string(image->step) + ", " + std::to_string(image->data.size()) +
                           " bytes: " + e.what());
}

boost::shared_ptr<ImageDetectionArray> detectionMessage(const std_msgs::Header& header, cv::Size image,
                                                        const core::Detections& detections,
                                                        const std::vector<std::string>& class_names,
                                                        const CameraModel* camera, const core::Plane& ground,
                                                        const core::RangeParams& params) {
  auto out = boost::make_shared<ImageDetectionArray>();
  out->header = header;
  out->width = static_cast<std::uint32_t>(image.width);
  out->height = static_cast<std::uint32_t>(image.height);
  for (const auto& detection : detections.detections) {
    auto d = unknownInSpace();
    d.id = static_cast<std::uint32_t>(out->detections.size());
    d.class_id = detection.class_id;
    d.label = class_names.at(static_cast<std::size_t>(detection.class_id));
    d.score = detection.score;
    d.x_min = detection.box.x_min;
    d.y_min = detection.box.y_min;
    d.x_max = detection.box.x_max;
    d.y_max = detection.box.y_max;
    d.cut = detection.cut;
    if (camera) setBearingAndRange(d, detection, detections.input_scale, *camera, ground, params);
    out->detections.push_back(std::move(d));
  }
  return out;
}

boost::shared_ptr<sensor_msgs::Image> annotated(const ImageView& image,
                                                const ImageDetectionArray& detections) {
  cv::Mat canvas;
  if (image.pixels.channels() == 1)
    cv::cvtColor(image.pixels, canvas, cv::COLOR_GRAY2BGR);
  else if (image.order == core::PixelOrder::kRgb)
    cv::cvtColor(image.pixels, canvas, cv::COLOR_RGB2BGR);
  else
    canvas = image.pixels.clone();
  draw(canvas, detections);
  return cv_bridge::CvImage(detections.header, encoding::BGR8, canvas).toImageMsg();
}

}  // namespace field_fusion
