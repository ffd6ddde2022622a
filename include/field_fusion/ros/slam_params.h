#pragma once
#include <string>

#include "field_fusion/core/map/grid_slam_params.h"
#include "field_fusion/core/map/scan_matcher.h"
#include "field_fusion/ros/other_names.h"

namespace field_fusion {

struct SlamStageParams {
  core::GridSlamParams slam;
  std::string base_frame = "base", odom_frame = "odom", map_frame = "map";
  bool publish_tf = true;
  double tf_delay = 0.1;
  double map_update_interval = 1.0;
  double misfit = 0.7;
  double local_way = 5.0, local_size = 10.0;
  std::string map_file;
  double start_x = 0.0, start_y = 0.0, start_yaw = 0.0, start_sigma = 0.5, start_sigma_yaw = 10.0;

  void declare(core::Params& p) {
    slam.declare(p);
    p.text("base_frame", base_frame, core::When::kStart, "The robot's own frame, x ahead.");
    p.text("odom_frame", odom_frame, core::When::kStart, "Frame in which TF tells the odometry.");
    p.text("map_frame", map_frame, core::When::kStart, "Frame of the map.");
    p.flag("publish_tf", publish_tf, core::When::kLive, "Whether map_frame to odom_frame goes to TF.");
    p.number("tf_delay", tf_delay, {0.0, 10.0}, "s", core::When::kLive,
             "That transform is stamped so much after its scan, so that it holds until the next one.");
    p.number("map_update_interval", map_update_interval, {0.0, 3600.0}, "s", core::When::kLive,
             "Map and path go out when so much time has passed between scans; 0: with each that is taken in.");
    p.number("misfit", misfit, {0.0, 1.0}, "", core::When::kLive,
             "A scan of which a smaller share of beams fits the map is told of in /diagnostics: was the robot carried?");
    p.number("local_way", local_way, {0.0, 1000.0}, "m", core::When::kLive,
             "The local map is that of so much of the last way.");
    p.number("local_size", local_size, {0.1, 100.0}, "m", core::When::kLive, "Side of the local map.");
    declareStart(p);
    p.rule([this] { return !base_frame.empty() && !odom_frame.empty() && !map_frame.empty(); },
           "base_frame, odom_frame and map_frame must have names");
    p.rule([this] { return base_frame != odom_frame && odom_frame != map_frame && map_frame != base_frame; },
           "base_frame, odom_frame and map_frame must differ");
  }

  /// What users of slam_gmapping have in their launch files.
  static OtherNames otherNames() {
    return {{{"linearUpdate", "linear_update"},
             {"angularUpdate", "angular_update", core::degrees(1.0)},
             {"temporalUpdate", "temporal_update"},
             {"minimumScore", "min_score"},
             {"resampleThreshold", "resample_threshold"},
             {"delta", "resolution"},
             {"maxUrange", "usable_range"},
             {"maxRange", "max_range"},
             {"occ_thresh", "occupied"}},
            {"throttle_scans", "transform_publish_period", "inverted_laser", "kernelSize", "lstep", "astep", "iterations",
             "lsigma", "ogain", "lskip", "xmin", "ymin", "xmax", "ymax", "llsamplerange", "llsamplestep", "lasamplerange",
             "lasamplestep"}};
  }

  core::PosePrior start() const {
    const double yaw = core::radians(start_sigma_yaw);
    const Eigen::Vector3d variances(start_sigma * start_sigma, start_sigma * start_sigma, yaw * yaw);
    return {{start_x, start_y, core::radians(start_yaw)}, variances.asDiagonal()};
  }

 private:
  void declareStart(core::Params& p) {
    const core::Range anywhere{-800000.0, 800000.0};
    p.text("map_file", map_file, core::When::kStart,
           "YAML file of a map to go on from, as map_server reads them; empty: a new map.");
    p.number("start_x", start_x, anywhere, "m", core::When::kStart, "Where in that map the robot starts.");
    p.number("start_y", start_y, anywhere, "m", core::When::kStart, "Likewise.");
    p.number("start_yaw", start_yaw, {-360.0, 360.0}, "deg", core::When::kStart, "Likewise.");
    p.number("start_sigma", start_sigma, {0.001, 10.0}, "m", core::When::kStart,
             "Standard deviation of start_x and start_y.");
    p.number("start_sigma_yaw", start_sigma_yaw, {0.01, 90.0}, "deg", core::When::kStart, "That of start_yaw.");
  }
};

}  // namespace field_fusion
