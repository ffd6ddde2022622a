#include <boost/make_shared.hpp>

#include <algorithm>
#include <cmath>

#include "field_fusion/ros/vision_output.h"

namespace field_fusion {
namespace {

using vision_msgs::Detection3D;
using vision_msgs::ObjectHypothesisWithPose;

constexpr double kAnyAngle = M_PI * M_PI / 3.0;  // rad^2, variance of an angle of which nothing is known

ObjectHypothesisWithPose hypothesis(const Obstacle& obstacle, const std::vector<std::string>& class_names) {
  ObjectHypothesisWithPose out;
  const auto place = std::find(class_names.begin(), class_names.end(), obstacle.label);
  out.id = place == class_names.end() ? -1 : place - class_names.begin();
  out.score = obstacle.label.empty() ? obstacle.existence : obstacle.label_probability;
  out.pose.pose.position = obstacle.position;
  out.pose.pose.orientation.w = 1.0;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      out.pose.covariance[6 * row + column] = obstacle.position_covariance[3 * row + column];
    out.pose.covariance[7 * (row + 3)] = kAnyAngle;
  }
  return out;
}

}  // namespace

boost::shared_ptr<vision_msgs::Detection3DArray> visionMessage(const ObstacleArray& obstacles,
                                                               const std::vector<std::string>& class_names) {
  const auto out = boost::make_shared<vision_msgs::Detection3DArray>();
  out->header = obstacles.header;
  for (const auto& obstacle : obstacles.obstacles) {
    if (std::isnan(obstacle.position.x)) continue;
    Detection3D detection;
    detection.header = obstacles.header;
    detection.results.push_back(hypothesis(obstacle, class_names));
    detection.bbox.center = detection.results[0].pose.pose;
    if (!std::isnan(obstacle.size.x)) detection.bbox.size = obstacle.size;
    out->detections.push_back(std::move(detection));
  }
  return out;
}

}  // namespace field_fusion
