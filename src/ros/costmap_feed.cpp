#include "field_fusion/ros/costmap_feed.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <stdexcept>

namespace field_fusion {
namespace {

/// Arrays of clusters that wait for the last revision of their obstacles: more than 1 s of a 20 Hz LiDAR.
constexpr std::size_t kMaxClusters = 32;

/// Clouds are large, and only those of the newest obstacles count.
constexpr std::size_t kMaxClouds = 8;

template <class Pointer>
void keep(std::deque<Pointer>& kept, const Pointer& message, std::size_t most) {
  kept.push_back(message);
  if (kept.size() > most) kept.pop_front();
}

template <class Pointer>
Pointer at(const std::deque<Pointer>& kept, const ros::Time& stamp) {
  const auto found = std::find_if(kept.rbegin(), kept.rend(),
                                  [&](const auto& message) { return message->header.stamp == stamp; });
  return found == kept.rend() ? nullptr : *found;
}

bool namesNoCluster(const ObstacleArray& obstacles) {
  return std::all_of(obstacles.obstacles.begin(), obstacles.obstacles.end(),
                     [](const Obstacle& o) { return o.cluster_id < 0; });
}

core::ObstacleBody cameraBody(const Obstacle& o) {
  core::ObstacleBody out;
  out.existence = o.existence;
  out.position = {o.position.x, o.position.y, o.position.z};
  out.radius = 0.5 * std::max(o.size.x, o.size.y);  // both are known, or both NaN
  return out;
}

bool samePlaces(const core::Cloud& a, const core::Cloud& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const core::Point& p, const core::Point& q) { return p.position() == q.position(); });
}

}  // namespace

void CostmapFeed::setParams(const CostmapParams& params) {
  core::checked(params);
  params_ = params;
  scanner_.setParams(params.scan);
}

void CostmapFeed::add(const ClusterArray::ConstPtr& clusters) {
  if (!clusters_.empty() && clusters->header.stamp <= clusters_.back()->header.stamp) reset();
  keep(clusters_, clusters, kMaxClusters);
}

void CostmapFeed::add(const CloudMessage::ConstPtr& points) { keep(clouds_, points, kMaxClouds); }

void CostmapFeed::reset() {
  clusters_.clear();
  clouds_.clear();
  camera_ = {};
  last_.reset();
}

bool CostmapFeed::ready(const ObstacleArray& obstacles) const {
  return at(clusters_, obstacles.header.stamp) || (obstacles.revision > 0 && namesNoCluster(obstacles));
}

CostmapFeed::Points CostmapFeed::take(const ObstacleArray& obstacles, const std::string& frame,
                                      const core::Transform& T_frame_lidar) {
  if (!ready(obstacles)) throw std::runtime_error("clusters missing: none with the stamp of the obstacles");
  const auto clusters = at(clusters_, obstacles.header.stamp);
  gather(obstacles, clusters.get());
  std_msgs::Header header = obstacles.header;
  header.frame_id = frame;
  if (obstacles.revision > 0 && header.stamp >= camera_.header.stamp) {
    camera_.header = header;
    camera_.points.clear();
    core::appendCameraPoints(bodies_, 2.0 * params_.scan.point_radius, T_frame_lidar, params_.points,
                             camera_.points);
  }
  if (last_ && header.stamp < last_->header.stamp) return {};
  const auto cloud = boost::make_shared<CloudMessage>();
  cloud->header = header;
  core::appendLidarPoints(bodies_, lidar_points_, T_frame_lidar, params_.points, cloud->points);
  const std::size_t from_lidar = cloud->points.size();
  if (fresh(header)) cloud->points.insert(cloud->points.end(), camera_.points.begin(), camera_.points.end());
  if (last_ && header.stamp == last_->header.stamp && samePlaces(cloud->points, last_->points)) return {};
  last_ = cloud;
  Points out{last_, from_lidar, clusters != nullptr, {}};
  if (const auto all = at(clouds_, header.stamp)) {
    core::ObstacleBody any;
    any.existence = 1.0;
    any.points.count = static_cast<std::uint32_t>(all->points.size());
    core::appendLidarPoints({any}, all->points, T_frame_lidar, params_.points, out.unclear);
  }
  return out;
}

bool CostmapFeed::fresh(const std_msgs::Header& header) const {
  return camera_.header.frame_id == header.frame_id &&
         (header.stamp - camera_.header.stamp).toSec() <= params_.camera_memory;
}

// Parts of a cluster that was split name it more than once: its points count once, if any of them counts.
void CostmapFeed::gather(const ObstacleArray& obstacles, const ClusterArray* clusters) {
  static const ClusterArray none;
  const ClusterArray& all = clusters ? *clusters : none;
  bodies_.clear();
  body_of_.assign(all.clusters.size(), -1);
  lidar_points_.clear();
  for (const auto& o : obstacles.obstacles) {
    if (o.cluster_id < 0) {
      bodies_.push_back(cameraBody(o));
      continue;
    }
    gather(static_cast<std::size_t>(o.cluster_id), o.existence, all);
    for (const auto piece : o.joined_clusters) gather(piece, o.existence, all);
  }
  lidar_points_.resize(all.points.size());
  for (std::size_t i = 0; i < lidar_points_.size(); ++i) {
    const auto& p = all.points[i];
    lidar_points_[i].x = p.x, lidar_points_[i].y = p.y, lidar_points_[i].z = p.z;
  }
}

void CostmapFeed::gather(std::size_t place, double existence, const ClusterArray& clusters) {
  if (place >= body_of_.size())
    throw std::runtime_error("obstacles damaged: cluster " + std::to_string(place) + " is named, of " +
                             std::to_string(body_of_.size()));
  if (body_of_[place] < 0) {
    body_of_[place] = static_cast<int>(bodies_.size());
    bodies_.emplace_back().points = {clusters.clusters[place].first_point,
                                     clusters.clusters[place].point_count};
  }
  auto& body = bodies_[static_cast<std::size_t>(body_of_[place])];
  body.existence = std::max(body.existence, existence);
}

boost::shared_ptr<sensor_msgs::LaserScan> CostmapFeed::scan(const Points& points) {
  const auto& scan = scanner_.run(points.cloud->points, points.looked, points.unclear);
  const auto out = boost::make_shared<sensor_msgs::LaserScan>();
  out->header = points.cloud->header;
  out->angle_min = static_cast<float>(scan.azimuth);
  out->angle_increment = static_cast<float>(scan.step);
  out->angle_max = static_cast<float>(scan.azimuth + scan.step * static_cast<double>(scan.ranges.size() - 1));
  out->range_min = static_cast<float>(params_.scan.range_min);
  out->range_max = static_cast<float>(params_.scan.range_max);
  out->ranges = scan.ranges;
  return out;
}

}  // namespace field_fusion
