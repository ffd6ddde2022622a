#pragma once
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/map/motion_noise.h"

namespace field_fusion::core {

struct GridSlamParams {
  int particles = 30;
  double linear_update = 0.25;
  double angular_update = 15.0;
  double temporal_update = -1.0;
  double resolution = 0.05;
  double min_range = 0.0;
  double usable_range = 40.0;
  double max_range = 80.0;
  double sigma = 0.03;
  double outlier = 3.0;
  double effective_beams = 600.0;
  double smoothing = 10.0;
  double min_score = 0.0;
  double resample_threshold = 0.5;
  double occupied = 0.25;
  double max_speed = 10.0;
  double max_turn_rate = 180.0;
  int path_length = 100000;
  MotionNoise motion;
  int threads = 0;
  int seed = 1;

  void declare(Params& p) {
    p.number("particles", particles, {1, 10000}, "", When::kStart, "Number of particles, each with a map.");
    p.number("linear_update", linear_update, {0.0, 100.0}, "m", When::kLive,
             "A scan is taken in after so much way.");
    p.number("angular_update", angular_update, {0.0, 360.0}, "deg", When::kLive,
             "A scan is taken in after so much turning.");
    p.number("temporal_update", temporal_update, {-1.0, 3600.0}, "s", When::kLive,
             "A scan is taken in after so much time, if the last is older; below 0: never for that.");
    p.number("resolution", resolution, {0.01, 1.0}, "m", When::kStart, "Side of a cell.");
    p.number("min_range", min_range, {0.0, 100.0}, "m", When::kLive, "Shorter ranges are left out.");
    p.number("usable_range", usable_range, {0.1, 200.0}, "m", When::kLive,
             "Longer beams only clear their way up to here.");
    p.number("max_range", max_range, {0.1, 1000.0}, "m", When::kLive, "Ranges from here on are left out.");
    p.number("sigma", sigma, {0.005, 1.0}, "m", When::kStart, "Standard deviation of a beam's end about its wall.");
    p.number("outlier", outlier, {1.0, 20.0}, "sigma", When::kStart,
             "Ends farther from a wall no longer pull the pose.");
    p.number("effective_beams", effective_beams, {1.0, 10000.0}, "", When::kStart,
             "A scan with more weighs as so many independent beams against odometry.");
    p.number("smoothing", smoothing, {1.0, 1000.0}, "", When::kLive,
             "The logarithm of a scan's likelihood is divided by it when particles are weighed.");
    p.number("min_score", min_score, {0.0, 100000.0}, "beams", When::kLive,
             "Odometry alone is believed where fewer beams fit the map.");
    p.number("resample_threshold", resample_threshold, {0.0, 1.0}, "", When::kLive,
             "Particles are drawn anew when fewer than this share of them count (N_eff).");
    p.number("occupied", occupied, {0.01, 0.99}, "", When::kStart,
             "Share of hits from which a cell is a wall for the matching.");
    p.number("max_speed", max_speed, {0.1, 1000.0}, "m/s", When::kLive,
             "Odometry that leaves more than 0.75 m beyond it between two scans has jumped: taken as no step. Lower it where "
             "scans are far apart and the robot is slow.");
    p.number("max_turn_rate", max_turn_rate, {1.0, 100000.0}, "deg/s", When::kLive,
             "Likewise of turns, beyond 60 degrees.");
    p.number("path_length", path_length, {10, 100000000}, "scans", When::kLive,
             "Of a longer path the beginning is forgotten: memory follows the map's area, not the time.");
    motion.declare(p);
    p.number("threads", threads, {0, 256}, "", When::kStart, "Threads, the caller's too; 0: as many as cores.");
    p.number("seed", seed, {0, 2147483647}, "", When::kStart, "Of all random draws.");
    p.rule([this] { return min_range < usable_range; }, "min_range must be below usable_range");
  }
};

}  // namespace field_fusion::core
