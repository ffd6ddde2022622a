#pragma once
// Obstacles as RViz shows them, after Figs. 7 and 9-13 of paper 001.
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "field_fusion/ObstacleArray.h"
#include "field_fusion/core/base/params.h"
#include "field_fusion/ros/marker_labels.h"
#include "field_fusion/ros/marker_shapes.h"
#include "field_fusion/ros/port.h"

namespace field_fusion {

struct MarkersParams {
  double dist_tolerance = 1.5;
  double sphere_size = 0.4;
  double line_width = 0.04;
  double letter_size = 0.45;
  double bearing_length = 20.0;
  double label_range = 25.0;
  int label_count = 6;

  void declare(core::Params& p) {
    const auto live = core::When::kLive;
    p.number("dist_tolerance", dist_tolerance, {0.001, 100.0}, "m", live,
             "Radius of the dashed circles; that of match.");
    p.number("sphere_size", sphere_size, {0.01, 10.0}, "m", live, "Diameter of the spheres.");
    p.number("line_width", line_width, {0.001, 1.0}, "m", live, "Width of the lines.");
    p.number("letter_size", letter_size, {0.01, 10.0}, "m", live,
             "Height of a letter 15 m away; farther ones grow.");
    p.number("bearing_length", bearing_length, {0.1, 1000.0}, "m", live,
             "Length of the line to a detection of unknown range.");
    p.number("label_range", label_range, {0.0, 1000.0}, "m", live,
             "What the LiDAR alone sees is labelled up to this range.");
    p.number("label_count", label_count, {0, 1000}, "labels", live, "At most so many of those, the nearest.");
  }
};

/// Draws one ObstacleArray after the other and removes what is no longer there, and nothing else.
class ObstacleMarkers {
 public:
  void setParams(const MarkersParams& params) { params_ = params; }
  boost::shared_ptr<visualization_msgs::MarkerArray> draw(const ObstacleArray& obstacles);

 private:
  using Marker = visualization_msgs::Marker;

  void clear();
  void addLidar(const Obstacle& obstacle);
  void addCamera(const Obstacle& obstacle);
  void addLabel(const Obstacle& obstacle, Layer layer, const Eigen::Vector3d& top);
  void labelNearest(const std::vector<Obstacle>& obstacles);
  Marker marker(const std_msgs::Header& header, Layer layer, int id, double size) const;
  void removeVanished(const std_msgs::Header& header, visualization_msgs::MarkerArray& out);

  MarkersParams params_;
  std::map<Layer, Points> points_;  // of each layer that is one marker
  std::vector<Label> labels_;
  std::vector<std::pair<std::string, int>> shown_;  // namespace and id, sorted
};

/// Markers have a header each and their array has none.
template <>
inline void Output<visualization_msgs::MarkerArray>::publish(
    const boost::shared_ptr<const visualization_msgs::MarkerArray>& message) {
  port_->last = {message->markers.empty() ? ros::Time() : message->markers[0].header.stamp, message.get()};
  ++port_->published;
  port_->publisher.publish(message);
}

}  // namespace field_fusion
