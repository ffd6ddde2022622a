#pragma once
// A satellite receiver, without satellites: position with white noise and a slowly wandering error.
#include <cstdint>
#include <random>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/sim/trajectory.h"

namespace field_fusion::core::sim {

/// Defaults: config/sensors/gnss.yaml.
struct GnssParams {
  double rate = 5.0;
  double noise = 0.3;
  double wander = 2.1;
  double wander_time = 60.0;
  double vertical_factor = 1.8;

  void declare(Params& p) {
    p.number("rate", rate, {0.1, 100.0}, "Hz", When::kStart, "Samples a second.");
    p.number("noise", noise, {0.0, 100.0}, "m", When::kStart, "White noise of east and of north.");
    p.number("wander", wander, {0.0, 100.0}, "m", When::kStart,
             "Slow error of east and of north: standard deviation.");
    p.number("wander_time", wander_time, {0.1, 100000.0}, "s", When::kStart,
             "In which the slow error forgets itself.");
    p.number("vertical_factor", vertical_factor, {0.0, 10.0}, "", When::kStart,
             "Errors of the height over those of the place.");
  }
};

struct GnssSample {
  double time = 0.0;                  ///< [s]
  Eigen::Vector3d position{0, 0, 0};  ///< [m] of the antenna: east, north, up in the world's frame
  Eigen::Vector3d sigma{0, 0, 0};     ///< [m] error to expect
};

class Gnss {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  Gnss(const GnssParams& params, const Trajectory& way, const Transform& T_base_antenna, std::uint64_t seed);
  GnssSample next();  ///< the samples at 0, 1/rate, 2/rate ... [s]

 private:
  Eigen::Vector3d draw(double sigma);

  GnssParams params_;
  Trajectory way_;
  Transform T_base_antenna_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d wander_;
  std::uint64_t count_ = 0;
};

}  // namespace field_fusion::core::sim
