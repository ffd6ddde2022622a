#include "field_fusion/ros/voxel_flow.h"

#include "field_fusion/core/cloud/depth_points.h"
#include "field_fusion/core/io/octree_file.h"
#include "field_fusion/ros/depth_message.h"
#include "field_fusion/ros/grid_message.h"
#include "field_fusion/ros/save_map.h"
#include "field_fusion/ros/voxel_markers.h"

namespace field_fusion {

void VoxelFlow::setParams(const VoxelStageParams& params) {
  if (map_) {
    map_->setLive(params.map);
    params_ = params;
    return;
  }
  params_ = params;
  reset();
}

void VoxelFlow::reset() {
  clear();
  if (!params_.map_file.empty()) core::readOctree(params_.map_file, *map_);
}

void VoxelFlow::clear() {
  map_ = std::make_unique<core::VoxelMap>(params_.map);
  header_ = {}, map_sent_ = {}, voxels_sent_ = {}, counts_ = {};
  header_.frame_id = params_.map_frame;
}

std_msgs::Header VoxelFlow::header() const {
  auto out = header_;
  if (out.stamp.isZero()) out.stamp = ros::Time::now();  // what was loaded is older than any cloud
  return out;
}

void VoxelFlow::run(const CloudMessage& cloud, const TfCache& tf) { insert(cloud.points, cloud.header, tf); }

void VoxelFlow::run(const sensor_msgs::Image& image, CameraFeed& camera, const TfCache& tf) {
  std::string why;
  const auto model = camera.modelFor(image, why);
  if (!model) throw std::runtime_error(why);
  withDepth(image, model->pinhole(),
            [&](const auto& depth) { core::depthPoints(depth, params_.image_step, points_); });
  insert(points_, image.header, tf);
}

core::Transform VoxelFlow::sensorIn(const std_msgs::Header& header, const TfCache& tf) const {
  core::Transform T_map_sensor = tf.lookup(params_.map_frame, header);
  if (params_.base_frame.empty()) return T_map_sensor;
  const double height = tf.lookup(params_.map_frame, params_.base_frame, header.stamp).translation().z();
  T_map_sensor.translation().z() += params_.base_height - height;
  return T_map_sensor;
}

void VoxelFlow::insert(const core::Cloud& cloud, const std_msgs::Header& header, const TfCache& tf) {
  const core::Transform T_map_sensor = sensorIn(header, tf);
  if (params_.thin) thin_.run(cloud, params_.map.resolution, thinned_);
  counts_ = map_->insert(params_.thin ? thinned_ : cloud, T_map_sensor);
  header_.stamp = header.stamp;
  sensor_ = T_map_sensor.translation();
  map_->keepAbout(sensor_.x(), sensor_.y());
}

bool VoxelFlow::isDue(ros::Time& sent, double interval) {
  if (!sent.isZero() && (header_.stamp - sent).toSec() < interval) return false;
  sent = header_.stamp;
  return true;
}

boost::shared_ptr<nav_msgs::OccupancyGrid> VoxelFlow::projected() const {
  const double side = params_.projected_size;
  return gridMessage(header_,
                     side > 0.0 ? map_->projectAbout(sensor_.x(), sensor_.y(), side) : map_->project());
}

boost::shared_ptr<visualization_msgs::MarkerArray> VoxelFlow::voxels() const {
  return voxelMarkers(header(), *map_);
}

void VoxelFlow::save(const SaveMap::Request& request, SaveMap::Response& answer) const {
  saveMap(request, answer, [this](const std::string& file) {
    if (!hasMap()) throw std::runtime_error("there is no voxel yet");
    core::writeOctree(file, *map_);
  });
}

void VoxelFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  if (!header_.stamp.isZero() && counts_.points == 0)
    status.mergeSummaryf(diagnostic_msgs::DiagnosticStatus::WARN,
                         "the last cloud has no usable point: finite, and within %.0f m of the map's origin",
                         core::kMostVoxels * params_.map.resolution);
  status.add("last cloud: points", counts_.points);
  status.add("last cloud: of them beyond the range", counts_.far);
  status.add("last cloud: unusable", counts_.unusable);
  status.add("last cloud: voxels occupied", counts_.occupied);
  status.add("last cloud: voxels free", counts_.free);
  status.add("map: cubes of 8 x 8 x 8 voxels", map_->store().size());
}

}  // namespace field_fusion
