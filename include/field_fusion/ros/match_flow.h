#pragma once
// From messages of clusters and detections to messages of obstacles.
#include <optional>
#include <string>
#include <vector>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/ObstacleArray.h"
#include "field_fusion/core/match/match.h"
#include "field_fusion/ros/match_record.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

/// Every message of clusters that comes in must have passed `check`.
class MatchFlow {
 public:
  struct Matched {
    boost::shared_ptr<ObstacleArray> obstacles;  ///< null: there is no frame to put them in
    ros::Time stamp;
    std::optional<ros::WallTime> arrival;  ///< of the clusters; none: the LiDAR is silent
    std::vector<std::string> faults;       ///< of each camera: why its bodies have no place, or empty
  };

  /// `params` must outlive this.
  MatchFlow(const core::MatchParams& params, const TfCache& tf);
  void onParams() { matcher_.setParams(params_); }

  /// Revision 0: from the LiDAR alone. It is the last word when it is not provisional.
  boost::shared_ptr<ObstacleArray> add(const ClusterArray::ConstPtr& clusters, ros::WallTime now);

  /// True when the detections have their transform, or none is needed yet.
  bool placeable(std::size_t camera, const ImageDetectionArray& detections) const;
  /// What is wrong with them: some are damaged and left out, or they came too late for their clusters.
  std::vector<std::string> add(std::size_t camera, const ImageDetectionArray::ConstPtr& detections,
                               ros::WallTime now);

  /// Revision 1, of the next instant that need wait no longer. Detections without a transform stay what the
  /// image alone shows.
  std::optional<Matched> next(ros::WallTime now);

  bool idle() const { return sync_.idle(); }  ///< time alone brings nothing
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reset();

 private:
  std::optional<core::CameraView> viewOf(std::size_t camera, const core::Sync::Frame& frame,
                                         std::string& fault) const;
  std_msgs::Header headerOf(const core::Sync::Frame& frame) const;

  const core::MatchParams& params_;
  const TfCache& tf_;
  core::Matcher matcher_;
  core::Sync sync_;
  MatchRecord record_;
  std::string frame_;  // of the last clusters
};

}  // namespace field_fusion
