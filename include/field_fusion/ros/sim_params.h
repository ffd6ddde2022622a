#pragma once
#include <string>
#include <vector>

#include "field_fusion/core/base/params.h"

namespace field_fusion {

/// What a run of the simulator consists of; the bag maker and the nodelet share it.
struct SimParams {
  std::string world = "usv_harbour";
  int seed = 1;
  std::vector<std::string> mounts;
  bool truth = true, static_tf = true;
  double grid_height = -1.0;
  bool depth_metres = false, depth_points = false, labels = false;

  void declare(core::Params& p) {
    using core::When;
    p.text("world", world, When::kStart,
           "File of the world, or the name of one that comes with the package.");
    p.number("seed", seed, {0, 2147483647}, "", When::kStart, 
           "Of every error that sensors make, and of what no user knows: true mounts, clocks, sizes.");
    p.texts("mounts", mounts, When::kStart, "Sensors that take part; empty: all.");
    p.flag("truth", truth, When::kStart, "Also what no stage may read: truth/...");
    p.flag("static_tf", static_tf, When::kStart,
           "Also /tf_static; not needed where robot_state_publisher has the robot's URDF.");
    p.flag("depth_metres", depth_metres, When::kStart, "Depth images also as 32FC1.");
    p.flag("depth_points", depth_points, When::kStart, "Depth images also as clouds.");
    p.number("grid_height", grid_height, {-1.0, 10000.0}, "m", When::kStart,
             "Height in the world of the slice in truth/grid; below 0: that of the first 2-D scanner, without one 0.3 m "
             "over the robot's foot.");
    p.flag("labels", labels, When::kStart, "With truth: which body each pixel of a camera shows.");
  }
};

/// Of a run in real time.
struct SimNodeParams {
  SimParams sim;
  double rate = 1.0;
  double seconds = 0.0;
  bool loop = false;

  void declare(core::Params& p) {
    using core::When;
    sim.declare(p);
    p.number("rate", rate, {0.01, 100.0}, "", When::kStart,
             "Simulated over real time, where the machine is fast enough; else time runs slower.");
    p.number("seconds", seconds, {0.0, 1e6}, "s", When::kStart, "Length of the run; 0: without end.");
    p.flag("loop", loop, When::kStart, "Start again after `seconds`: time jumps back.");
  }
};

}  // namespace field_fusion
