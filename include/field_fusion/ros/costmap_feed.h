#pragma once
#include <sensor_msgs/LaserScan.h>

#include <deque>
#include <string>
#include <vector>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ObstacleArray.h"
#include "field_fusion/core/match/obstacle_points.h"
#include "field_fusion/core/match/obstacle_scan.h"
#include "field_fusion/ros/cloud_message.h"

namespace field_fusion {

struct CostmapParams {
  core::ObstaclePointsParams points;
  core::ObstacleScanParams scan;
  double camera_memory = 0.5;
  std::string frame;
  std::vector<std::string> class_names;

  void declare(core::Params& p) {
    points.declare(p);
    scan.declare(p);
    p.number(
        "camera_memory", camera_memory, {0.0, 10.0}, "s", core::When::kLive,
        "How long what the camera alone saw stays among the obstacles until the camera answers anew: its "
        "answers are slower than the LiDAR.");
    p.text("frame", frame, core::When::kStart,
           "Frame of the outputs, level and at the LiDAR or nearly so; empty: that of the clusters.");
    p.texts("class_names", class_names, core::When::kStart,
            "obstacle_detections: the number of a class is its place in this list, -1 for all others.");
  }
};

/// Brings obstacles and the points of their clusters together, and keeps what the camera alone saw while the
/// LiDAR is already further on.
class CostmapFeed {
 public:
  struct Points {
    CloudMessage::ConstPtr cloud;
    std::size_t from_lidar = 0;  ///< of the points, the first so many
    bool looked = false;         ///< the LiDAR did: where no obstacle is, none was seen
    core::Cloud unclear;         ///< of the clusterer's input, without saying which are in a cluster
  };

  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const CostmapParams& params);

  /// Takes clusters that passed `check`. Their stamps rise; one that does not is the first of a new
  /// subscription: starts anew.
  void add(const ClusterArray::ConstPtr& clusters);

  /// Takes the points from which the clusters were made. Those that no cluster took may still be a body, too
  /// small or too far away: the scan does not call their rays free.
  void add(const CloudMessage::ConstPtr& points);

  /// Whether the obstacles need not wait for their clusters: what the camera says while the LiDAR is silent
  /// has none.
  bool ready(const ObstacleArray& obstacles) const;

  /// The points of obstacles that passed `check`, carried into `frame`, with their stamp; no cloud where
  /// nothing has changed since the revision before, or newer points have already gone out. Throws
  /// std::runtime_error "clusters missing: ..." or "obstacles damaged: ...".
  Points take(const ObstacleArray& obstacles, const std::string& frame, const core::Transform& T_frame_lidar);

  /// The scan of what `take` gave.
  boost::shared_ptr<sensor_msgs::LaserScan> scan(const Points& points);

  void reset();

 private:
  void gather(const ObstacleArray& obstacles, const ClusterArray* clusters);
  void gather(std::size_t place, double existence, const ClusterArray& clusters);
  bool fresh(const std_msgs::Header& header) const;

  CostmapParams params_;
  core::ObstacleScanner scanner_;
  std::deque<ClusterArray::ConstPtr> clusters_;  // the newest last
  std::deque<CloudMessage::ConstPtr> clouds_;    // the newest last
  std::vector<core::ObstacleBody> bodies_;
  std::vector<int> body_of_;  // each cluster; -1: none
  core::Cloud lidar_points_;
  CloudMessage camera_;          // the camera's last answer
  CloudMessage::ConstPtr last_;  // that went out
};

}  // namespace field_fusion
