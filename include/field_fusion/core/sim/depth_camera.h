#pragma once
// An active stereo depth camera such as Intel RealSense D435.
#include "field_fusion/core/base/params.h"
#include "field_fusion/core/sim/beam_random.h"
#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/pose_track.h"
#include "field_fusion/core/base/workers.h"

namespace field_fusion::core::sim {

struct DepthCameraParams {
  double rate = 30.0;
  int width = 640, height = 480;
  double focal_length = 399.4;
  double baseline = 0.05;
  double min_range = 0.28, max_range = 10.0;
  double disparity_noise = 0.08;
  double depth_scale = 0.0;
  int noise_grain = 4;
  double disparity_step = 0.03125;
  double depth_step = 0.001;
  double projector_range = 12.0, texture_weight = 2.0, match_noise = 0.25;
  double edge_loss = 0.5;
  int threads = 0;

  void declare(Params& p) {
    declareOptics(p);
    p.number("disparity_noise", disparity_noise, {0.0, 5.0}, "px", When::kStart,
             "Sigma of the match; makes an error of depth that grows with its square.");
    p.number("depth_scale", depth_scale, {0.0, 0.2}, "", When::kStart,
             "Error of depth in proportion to it, drawn once per seed between minus and plus this.");
    p.number("noise_grain", noise_grain, {1, 64}, "px", When::kStart,
             "Errors and holes of pixels so far apart are independent: the window that is matched.");
    p.number("disparity_step", disparity_step, {0.0, 1.0}, "px", When::kStart,
             "Disparities are multiples of it; 0: any.");
    p.number("depth_step", depth_step, {0.0, 0.1}, "m", When::kStart, "Depths are multiples of it; 0: any.");
    p.number("projector_range", projector_range, {0.0, 1000.0}, "m", When::kStart,
             "A white surface without texture, hit squarely, is matched every other time so far away.");
    p.number("texture_weight", texture_weight, {0.0, 1000.0}, "", When::kStart,
             "How well texture alone is matched: this times its contrast of 0 to 1; 1: every other time.");
    p.number("match_noise", match_noise, {0.0, 2.0}, "", When::kStart, "Sigma of how well a match goes.");
    p.number("edge_loss", edge_loss, {0.0, 1.0}, "", When::kStart,
             "Share of pixels beside a step in depth that have none.");
    p.number("threads", threads, {0, 64}, "", When::kStart, "That share a frame; 0: as many as cores.");
    p.rule([this] { return min_range < max_range; }, "min_range must be below max_range");
  }

 private:
  void declareOptics(Params& p) {
    p.number("rate", rate, {0.1, 1000.0}, "Hz", When::kStart, "Frames a second.");
    p.number("width", width, {2, 8192}, "px", When::kStart, "Columns of the image.");
    p.number("height", height, {2, 8192}, "px", When::kStart, "Rows of the image.");
    p.number("focal_length", focal_length, {1.0, 100000.0}, "px", When::kStart,
             "Of the left imager; the principal point is the image's middle.");
    p.number("baseline", baseline, {0.001, 10.0}, "m", When::kStart,
             "From the left imager to the right one.");
    p.number("min_range", min_range, {0.01, 100.0}, "m", When::kStart, "Nearer than this there is no depth.");
    p.number("max_range", max_range, {0.1, 1000.0}, "m", When::kStart,
             "Farther than this there is no depth.");
  }
};

/// Depth along the optical axis. Pixel (0, 0) is the left upper one and its middle the place (0, 0).
struct DepthImage {
  double stamp = 0.0;  ///< [s]
  int width = 0, height = 0;
  double focal_length = 0.0, centre_x = 0.0, centre_y = 0.0;  ///< [px]
  std::vector<float> metres;                                  ///< NaN: none
  std::vector<std::uint16_t> millimetres;                     ///< the same as a camera sends it; 0: none
};

struct DepthTruth {
  std::vector<float> metres;  ///< NaN where nothing is seen
  std::vector<int> bodies;    ///< as Hit::body
};

/// The left imager sees, the right one is matched to it: what only the left sees, and what has no texture,
/// has no depth. Both shutters are global: a frame is of one instant.
class DepthCamera {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  DepthCamera(const DepthCameraParams& params, std::uint64_t seed);

  /// A frame taken at `stamp` by a camera that looks along the sensor's x. Stays valid until the next call
  /// and does not depend on DepthCameraParams::threads.
  const DepthImage& frame(Caster& caster, const PoseAt& T_world_sensor, double stamp);
  const DepthTruth& truth() const { return truth_; }  ///< of the last frame

  const DepthCameraParams& params() const { return params_; }
  double scale() const { return scale_; }  ///< error drawn within depth_scale

 private:
  void castRow(const Caster& caster, const PoseTrack::Pose& pose, int row);
  void matchRow(int row, std::uint64_t seed);
  bool atStep(int row, int column) const;
  void drawGrains(std::uint64_t seed);
  float grainNoise(const std::vector<float>& grains, int row, int column) const;
  float measured(float depth, int row, int column, std::uint64_t seed) const;

  DepthCameraParams params_;
  std::uint64_t seed_;
  Workers workers_;
  double scale_;
  DepthImage image_;
  DepthTruth truth_;
  std::vector<float> match_;  // how well each pixel can be matched; 1: every other time
  // of every noise_grain-th pixel of every noise_grain-th row: noise of the disparity and of the match
  std::vector<float> disparity_grains_, match_grains_;
};

}  // namespace field_fusion::core::sim
