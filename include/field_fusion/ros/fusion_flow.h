#pragma once
// From messages of two maps to the fused one.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <nav_msgs/OccupancyGrid.h>

#include "field_fusion/SaveMap.h"
#include "field_fusion/core/map/map_fusion.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

struct FusionStageParams {
  core::MapFusionParams fusion;
  bool map_whole = true, projected_whole = false;
  std::string base_frame = "base";
  double local_size = 10.0;
  double publish_interval = 0.2;

  void declare(core::Params& p) {
    fusion.declare(p);
    p.flag("map_whole", map_whole, core::When::kLive,
           "Whether each map A is all that is known, so that what it no longer tells of is forgotten; a "
           "local map is not.");
    p.flag("projected_whole", projected_whole, core::When::kLive, "Likewise of map B.");
    p.text("base_frame", base_frame, core::When::kStart,
           "The robot's own frame: the fused local map is about it.");
    p.number("local_size", local_size, {0.1, 1000.0}, "m", core::When::kLive, "Side of that map.");
    p.number("publish_interval", publish_interval, {0.0, 60.0}, "s", core::When::kLive,
             "From one fused map to the next (stamps); 0: with each map that comes.");
    p.rule([this] { return !base_frame.empty(); }, "base_frame must have a name");
  }
};

class FusionFlow {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const FusionStageParams& params);
  void reset();

  /// Both throw what core::MapFusion throws, and "frame missing: ...", "frame differs: ..." or "map turned: ...". Map A says
  /// which frame and resolution are right: the first one clears what maps B of others have told.
  void addMap(const nav_msgs::OccupancyGrid& map);
  void addProjected(const nav_msgs::OccupancyGrid& map);

  bool hasMap() const { return maps_ + projected_ > 0; }
  bool isDue();  ///< once for each interval
  boost::shared_ptr<nav_msgs::OccupancyGrid> fused() const;
  /// Null, and it is said in /diagnostics, while TF does not know where the robot is.
  boost::shared_ptr<nav_msgs::OccupancyGrid> local(const TfCache& tf);
  void save(const SaveMap::Request& request, SaveMap::Response& answer) const;
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  bool fits(const nav_msgs::OccupancyGrid& map) const;
  core::Occupancy checked(const nav_msgs::OccupancyGrid& map) const;
  void taken(const nav_msgs::OccupancyGrid& map, double& shift);

  FusionStageParams params_;
  core::MapFusion fusion_;
  std_msgs::Header header_;
  ros::Time sent_;
  int maps_ = 0, projected_ = 0;
  double map_shift_ = 0.0, projected_shift_ = 0.0;  // [cells]
  bool lost_ = false;                               // where the robot is, at the last local map
};

}  // namespace field_fusion
