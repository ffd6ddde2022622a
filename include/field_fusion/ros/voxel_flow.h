#pragma once
// From messages of depth to a map of voxels and its projection.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/Image.h>
#include <visualization_msgs/MarkerArray.h>

#include <memory>

#include "field_fusion/SaveMap.h"
#include "field_fusion/core/cloud/voxel.h"
#include "field_fusion/core/map/voxel_map.h"
#include "field_fusion/ros/camera_feed.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

struct VoxelStageParams {
  enum class Source { kPoints, kImage };
  Source source = Source::kPoints;
  core::VoxelMapParams map;
  int image_step = 2;
  bool thin = true;
  std::string map_frame = "map";
  std::string base_frame;
  double base_height = 0.0;
  double publish_interval = 0.1;
  double voxels_interval = 1.0;
  double projected_size = 10.0;
  std::string map_file;

  void declare(core::Params& p) {
    p.choice("source", source, {"points", "image"}, core::When::kStart,
             "What comes in: a cloud, or a rectified depth image with its CameraInfo.");
    map.declare(p);
    p.number("image_step", image_step, {1, 64}, "px", core::When::kLive,
             "Each such pixel of each such row of an image counts.");
    p.flag("thin", thin, core::When::kLive,
           "Whether one point of a voxel counts, the one in its middle: the voxel filter of paper 004. Else "
           "all do, for a fuller free space.");
    p.text("map_frame", map_frame, core::When::kStart,
           "Frame of the map, z up; its pose of the sensor comes from TF.");
    p.text("base_frame", base_frame, core::When::kStart,
           "Frame of a robot on flat ground, such as base, whose height in map_frame counts as base_height: that of "
           "odometry drifts, and floor would be obstacles. Empty: heights are as TF says.");
    p.number("base_height", base_height, {-10.0, 10.0}, "m", core::When::kLive,
             "Of base_frame over the ground; 0: it lies on it.");
    p.number("publish_interval", publish_interval, {0.0, 60.0}, "s", core::When::kLive,
             "From one projected map to the next (stamps); 0: with each cloud.");
    p.number("voxels_interval", voxels_interval, {0.0, 60.0}, "s", core::When::kLive,
             "Likewise of the voxels for RViz, and of the octree.");
    p.number("projected_size", projected_size, {0.0, 1000.0}, "m", core::When::kLive,
             "Side of the projected map, about the sensor; 0: all that is known.");
    p.text("map_file", map_file, core::When::kStart,
           "Voxels to go on from, .ot or .bt as OctoMap writes them; empty: none. Of them, too, only those in `window` are kept.");
    p.rule([this] { return !map_frame.empty(); }, "map_frame must have a name");
  }
};

class VoxelFlow {
 public:
  /// The first time loads the map. Throws std::invalid_argument with every fault of the parameters,
  /// std::runtime_error for the map.
  void setParams(const VoxelStageParams& params);
  bool ready(const std_msgs::Header& header, const TfCache& tf) const {
    return tf.has(params_.map_frame, header) &&
           (params_.base_frame.empty() || tf.has(params_.map_frame, params_.base_frame, header.stamp));
  }
  void reset();  ///< begins anew, with map_file; throws std::runtime_error where that cannot be read, and is empty then
  void clear();  ///< forgets all voxels

  /// Both throw std::runtime_error where the transform is missing; the second also without a usable CameraInfo,
  /// and what withDepth throws.
  void run(const CloudMessage& cloud, const TfCache& tf);
  void run(const sensor_msgs::Image& image, CameraFeed& camera, const TfCache& tf);

  // of the last cloud
  bool mapIsDue() { return isDue(map_sent_, params_.publish_interval); }
  bool voxelsAreDue() { return isDue(voxels_sent_, params_.voxels_interval); }
  boost::shared_ptr<nav_msgs::OccupancyGrid> projected() const;
  boost::shared_ptr<visualization_msgs::MarkerArray> voxels() const;
  bool hasMap() const { return map_->store().size() > 0; }
  std_msgs::Header header() const;
  const core::VoxelMap& map() const { return *map_; }

  void save(const SaveMap::Request& request, SaveMap::Response& answer) const;
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  bool isDue(ros::Time& sent, double interval);
  core::Transform sensorIn(const std_msgs::Header& header, const TfCache& tf) const;
  void insert(const core::Cloud& cloud, const std_msgs::Header& header, const TfCache& tf);

  VoxelStageParams params_;
  std::unique_ptr<core::VoxelMap> map_;
  core::Voxels thin_;
  core::Cloud points_, thinned_;
  core::VoxelCounts counts_;
  std_msgs::Header header_;  // stamp of the last cloud, frame of the map
  Eigen::Vector3d sensor_ = Eigen::Vector3d::Zero();
  ros::Time map_sent_, voxels_sent_;
};

}  // namespace field_fusion
