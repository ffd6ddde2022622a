#pragma once
// Our messages to and from what core works on.
#include <boost/shared_ptr.hpp>

#include <vector>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/ObstacleArray.h"
#include "field_fusion/core/cloud/cluster.h"
#include "field_fusion/core/match/obstacle.h"

namespace field_fusion {

/// Throws std::runtime_error "clusters damaged: details" where a cluster is not finite, inside out, not in
/// its place, names points that are not there, or has an oriented box that is neither sound nor all NaN.
void check(const ClusterArray& message);

/// The message without its damaged detections; the very same message where there are none. Damaged is one
/// that is not in its place, whose score is no probability, whose box is inside out or not in the image,
/// whose ray is no unit vector, or whose range or sigma is negative or infinite; NaN is unknown, but not for
/// score and box. `damage` becomes "detections damaged: details" of the first, or empty.
ImageDetectionArray::ConstPtr soundDetections(const ImageDetectionArray::ConstPtr& message,
                                              std::string& damage);

/// Throws std::runtime_error "obstacles damaged: details" where a number of an obstacle is neither possible
/// nor unknown (NaN).
void check(const ObstacleArray& message);

boost::shared_ptr<ClusterArray> clusterMessage(const std_msgs::Header& header,
                                               const core::Clusters& clusters);

/// The clusters of a message that passed `check`.
std::vector<core::Cluster> clustersOf(const ClusterArray& message);

/// Their points, positions alone; Cluster::points names them.
std::vector<core::Point> pointsOf(const ClusterArray& message);

/// The sound detections of a message, also carried into the LiDAR's frame. Where
/// `T_lidar_camera` is null nothing is known of their place.
core::CameraView cameraViewOf(const ImageDetectionArray& message, const core::Transform* T_lidar_camera);

boost::shared_ptr<ObstacleArray> obstacleMessage(const std_msgs::Header& header, std::uint8_t revision,
                                                 bool provisional,
                                                 const std::vector<core::Obstacle>& obstacles);

}  // namespace field_fusion
