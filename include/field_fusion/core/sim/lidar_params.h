#pragma once
// How good a LiDAR is. Numbers of real ones, with their sources, are in config/sensors/.
#include "field_fusion/core/base/params.h"

namespace field_fusion::core::sim {

/// Which of several returns of one beam is reported.
enum class Echo { kStrongest, kFirst, kLast };
/// When a beam is sampled by more than its central ray.
enum class SpotSampling { kEdges, kAlways, kNever };
enum class Intensity { kReflectivity, kDecibel };

struct LidarParams {
  double min_range = 0.5, max_range = 40.0;
  double ten_percent_range = 30.0;
  double energy_noise = 0.1;
  double spot_width = 8.0, spot_height = 8.0;
  double divergence_width = 15.0, divergence_height = 15.0;
  SpotSampling spot_sampling = SpotSampling::kEdges;
  double pulse_length = 0.75;
  Echo echo = Echo::kStrongest;
  double range_noise = 0.012, range_noise_square = 0.0, range_noise_weak = 0.0, slant_noise = 0.1;
  double range_bias = 0.03, range_scale = 0.0;
  double angle_noise = 0.0;
  double range_step = 0.001;
  double fault_rate = 0.0;
  Intensity intensity = Intensity::kReflectivity;
  double intensity_scale = 100.0;
  int threads = 1;

  void declare(Params& p) {
    declareReturns(p);
    declareSpot(p);
    declareErrors(p);
    p.number("threads", threads, {0, 64}, "", When::kStart, "That share a scan; 0: as many as cores.");
    p.rule([this] { return min_range < max_range; }, "min_range must be below max_range");
  }

 private:
  void declareReturns(Params& p) {
    p.number("min_range", min_range, {0.0, 100.0}, "m", When::kStart, "Nearer targets give no range.");
    p.number("max_range", max_range, {0.1, 1000.0}, "m", When::kStart, "Longest range that is reported.");
    p.number("ten_percent_range", ten_percent_range, {0.1, 1000.0}, "m", When::kStart,
             "Range at which a matt target of 10 % reflectivity, hit squarely, is seen every other time.");
    p.number("energy_noise", energy_noise, {0.0, 1.0}, "", When::kStart,
             "Sigma of the energy of a return, as a share of it: speckle and receiver.");
    p.choice("echo", echo, {"strongest", "first", "last"}, When::kStart, "Return that is reported.");
    p.choice("intensity", intensity, {"reflectivity", "decibel"}, When::kStart,
             "reflectivity: made independent of range. decibel: logarithm of energy over the threshold.");
    p.number("intensity_scale", intensity_scale, {0.0, 10000.0}, "", When::kStart,
             "Intensity of a white target hit squarely, or of one decibel; 255 at most is reported.");
  }
  void declareSpot(Params& p) {
    p.number("spot_width", spot_width, {0.0, 100.0}, "mm", When::kStart, "Width of the beam at its exit.");
    p.number("spot_height", spot_height, {0.0, 100.0}, "mm", When::kStart, "Height of the beam at its exit.");
    p.number("divergence_width", divergence_width, {0.0, 100.0}, "mrad", When::kStart,
             "By how much the beam widens with range, full angle.");
    p.number("divergence_height", divergence_height, {0.0, 100.0}, "mrad", When::kStart,
             "By how much the beam gets higher with range, full angle.");
    p.choice("spot_sampling", spot_sampling, {"edges", "always", "never"}, When::kStart,
             "Where the spot has a size. edges: where neighbouring beams see no common surface.");
    p.number("pulse_length", pulse_length, {0.0, 10.0}, "m", When::kStart,
             "Returns of one beam nearer to each other than this melt into one between them.");
  }
  void declareErrors(Params& p) {
    p.number("range_noise", range_noise, {0.0, 1.0}, "m", When::kStart, "Sigma at any range.");
    p.number("range_noise_square", range_noise_square, {0.0, 1.0}, "1/m", When::kStart,
             "Sigma over the square of range: triangulation.");
    p.number("range_noise_weak", range_noise_weak, {0.0, 1.0}, "m", When::kStart,
             "Sigma of a return at the threshold; falls with the square root of its energy.");
    p.number("slant_noise", slant_noise, {0.0, 1.0}, "", When::kStart,
             "Sigma over the spread of range within the spot on a slanting surface.");
    p.number("range_bias", range_bias, {0.0, 1.0}, "m", When::kStart,
             "Constant error of each row, drawn once per seed between minus and plus this.");
    p.number("range_scale", range_scale, {0.0, 0.1}, "", When::kStart,
             "Error in proportion to range, drawn once per seed between minus and plus this.");
    p.number("angle_noise", angle_noise, {0.0, 5.0}, "deg", When::kStart,
             "Sigma of the azimuth in which a beam looks, about the one reported.");
    p.number("range_step", range_step, {0.0, 1.0}, "m", When::kStart, "Ranges are multiples of it; 0: any.");
    p.number("fault_rate", fault_rate, {0.0, 1.0}, "", When::kStart, "Share of beams that measure nonsense.");
  }
};

}  // namespace field_fusion::core::sim
