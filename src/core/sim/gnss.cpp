#include "field_fusion/core/sim/gnss.h"

#include <cmath>

#include "field_fusion/core/base/checked.h"

namespace field_fusion::core::sim {

Gnss::Gnss(const GnssParams& params, const Trajectory& way, const Transform& T_base_antenna,
           std::uint64_t seed)
    : params_(checked(params)), way_(way), T_base_antenna_(T_base_antenna), random_(seed) {
  wander_ = draw(params_.wander);
}

Eigen::Vector3d Gnss::draw(double sigma) {
  Eigen::Vector3d out;
  for (int i = 0; i < 3; ++i) out[i] = sigma * normal_(random_);
  out.z() *= params_.vertical_factor;
  return out;
}

GnssSample Gnss::next() {
  GnssSample sample;
  sample.time = static_cast<double>(count_++) / params_.rate;
  sample.position = (way_.pose(sample.time) * T_base_antenna_).translation() + wander_ + draw(params_.noise);
  const double sigma = std::hypot(params_.noise, params_.wander);
  sample.sigma = {sigma, sigma, sigma * params_.vertical_factor};
  // Gauss-Markov of first order: keeps its standard deviation
  const double kept = std::exp(-1 / (params_.rate * params_.wander_time));
  wander_ = kept * wander_ + draw(params_.wander * std::sqrt(1 - kept * kept));
  return sample;
}

}  // namespace field_fusion::core::sim
