#pragma once
// How long and with which gain a camera exposes.
#include "field_fusion/core/sim/camera_params.h"

namespace field_fusion::core::sim {

class Exposure {
 public:
  explicit Exposure(const CameraParams& params);

  double time() const { return time_; }  ///< [s]
  double gain() const { return gain_; }  ///< factor
  /// Brightness 0..1 of a pixel over the radiance that it sees.
  double scale() const { return time_ / white_time_ * gain_; }
  bool automatic() const { return automatic_; }

  /// The next picture is taken `later` seconds after one whose mean brightness was `mean`. Its scale is
  /// pulled to the wanted one by the share 1 - exp(-later / delay), in the logarithm. Without
  /// auto_exposure nothing happens.
  void follow(double mean, double later);

 private:
  void set(double scale);

  bool automatic_;
  double wanted_, delay_, longest_, highest_, white_time_;
  double time_, gain_;
};

}  // namespace field_fusion::core::sim
