#pragma once
// Boxes of a bag as YOLO's label files have them: a line for each, `class cx cy w h` over the picture's size.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "field_fusion/ImageDetectionArray.h"

namespace field_fusion {

/// What is less is not labelled: bodies that hardly show, boxes too small to tell what they are.
struct LabelLimits {
  double score = 0.2;
  double area = 25.0;  ///< [px^2]
};

using LabelFiles = std::map<ros::Time, std::string>;  ///< text by the picture's stamp

inline std::vector<std::string> readClasses(const std::string& file) {
  try {
    return YAML::LoadFile(file)["names"].as<std::vector<std::string>>();
  } catch (const YAML::Exception& fault) {
    throw std::runtime_error(file + ": needs a list of names: " + fault.what());
  }
}

/// What of a box lies within the picture, as a line; empty where that is less than the limits. Throws std::runtime_error.
inline std::string labelLine(const ImageDetection& d, const ImageDetectionArray& array, const std::vector<std::string>& classes,
                             const LabelLimits& limits) {
  const auto known = std::find(classes.begin(), classes.end(), d.label);
  if (known == classes.end()) throw std::runtime_error("class " + d.label + " is not in the list of classes");
  if (!(d.x_min <= d.x_max && d.y_min <= d.y_max && std::isfinite(d.score)))
    throw std::runtime_error("the box of a " + d.label + " is inside out or not finite, or its score is");
  const double width = array.width, height = array.height;
  const double x0 = std::clamp<double>(d.x_min, 0.0, width), x1 = std::clamp<double>(d.x_max, 0.0, width);
  const double y0 = std::clamp<double>(d.y_min, 0.0, height), y1 = std::clamp<double>(d.y_max, 0.0, height);
  if (d.score < limits.score || !((x1 - x0) * (y1 - y0) >= limits.area) || x0 == x1 || y0 == y1) return "";
  return cv::format("%d %.6f %.6f %.6f %.6f\n", static_cast<int>(known - classes.begin()), 0.5 * (x0 + x1) / width,
                    0.5 * (y0 + y1) / height, (x1 - x0) / width, (y1 - y0) / height);
}

inline std::string labelText(const ImageDetectionArray& array, const std::vector<std::string>& classes,
                             const LabelLimits& limits) try {
  if (array.width == 0 || array.height == 0) throw std::runtime_error("the size of the picture is missing");
  std::string text;
  for (const ImageDetection& d : array.detections) text += labelLine(d, array, classes, limits);
  return text;
} catch (const std::runtime_error& fault) {
  throw std::runtime_error("boxes of stamp " + std::to_string(array.header.stamp.toSec()) + ": " + fault.what());
}

inline LabelFiles readLabels(const rosbag::Bag& bag, const std::string& topic,
                             const std::string& classes_file, const LabelLimits& limits) {
  const std::vector<std::string> classes = readClasses(classes_file);
  LabelFiles out;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& message : view) {
    const auto array = message.instantiate<ImageDetectionArray>();
    if (!array) throw std::runtime_error(topic + " has no ImageDetectionArray but " + message.getDataType());
    out[array->header.stamp] = labelText(*array, classes, limits);
  }
  if (out.empty()) throw std::runtime_error("the bag has nothing on " + topic);
  return out;
}

}  // namespace field_fusion
