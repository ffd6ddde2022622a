#pragma once
// Boxes of a bag as YOLO's label files have them: a line for each, `class cx cy w h` over the picture's size.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
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

inline std::string labelText(const ImageDetectionArray& array, const std::vector<std::string>& classes,
                             const LabelLimits& limits) {
  std::string text;
  for (const ImageDetection& d : array.detections) {
    const auto known = std::find(classes.begin(), classes.end(), d.label);
    if (known == classes.end())
      throw std::runtime_error("class " + d.label + " is not in the list of classes");
    const double w = d.x_max - d.x_min, h = d.y_max - d.y_min;
    if (d.score < limits.score || w * h < limits.area) continue;
    text += cv::format("%d %.6f %.6f %.6f %.6f\n", static_cast<int>(known - classes.begin()),
                       0.5 * (d.x_min + d.x_max) / array.width, 0.5 * (d.y_min + d.y_max) / array.height,
                       w / array.width, h / array.height);
  }
  return text;
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
