#include "field_fusion/core/match/gate.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

constexpr double kPi = 3.14159265358979323846;

double square(double x) { return x * x; }

/// Both in [-pi, pi]. std::remainder costs more than all the rest.
double turn(double a, double b) {
  const double difference = a - b;
  return difference > kPi ? difference - 2.0 * kPi : difference < -kPi ? difference + 2.0 * kPi : difference;
}

double chiSquareShare3(double x) {
  return std::erf(std::sqrt(x / 2.0)) - std::sqrt(2.0 * x / kPi) * std::exp(-x / 2.0);
}

}  // namespace

double chiSquareQuantile(double probability, int degrees_of_freedom) {
  if (degrees_of_freedom == 2) return -2.0 * std::log1p(-probability);
  double low = 0.0, high = 100.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (chiSquareShare3(middle) < probability ? low : high) = middle;
  }
  return high;
}

void Gate::setParams(const GateParams& params, double range_sigma, double bearing_sigma) {
  params_ = params;
  range_variance_ = square(range_sigma);
  bearing_variance_ = square(bearing_sigma);
  limit2_ = chiSquareQuantile(params.gate_probability, 2);
  limit3_ = chiSquareQuantile(params.gate_probability, 3);
}

Likeness Gate::compare(const Sight& sight, const CameraTarget& target) const {
  const bool box = target.box.known();
  const double box_width = box ? target.box.width() : 0.0, box_height = box ? target.box.height() : 0.0;
  const double flat = std::max(0.1, std::cos(target.seen.elevation));  // azimuths spread towards the poles
  const bool range = std::isfinite(target.seen.range) && target.range_sigma > 0.0;

  const Eigen::Array3d difference(range ? sight.centre.range - target.seen.range : 0.0,
                                  turn(sight.centre.azimuth, target.seen.azimuth),
                                  sight.centre.elevation - target.seen.elevation);
  const Eigen::Array3d least(range ? square(target.range_sigma) + range_variance_ : 1.0,
                             (bearing_variance_ + square(params_.box_error * box_width)) / square(flat),
                             bearing_variance_ + square(params_.box_error * box_height));
  const Eigen::Array3d spread(range ? sight.depth : 0.0, (sight.width - box_width) / flat,
                              sight.height - box_height);
  const Eigen::Array3d variance = least + spread.square() / 12.0;

  Likeness out;
  out.terms = difference.square() / variance;
  out.distance2 = out.terms.sum();
  out.inside = out.distance2 <= (range ? limit3_ : limit2_);  // NaN is outside
  if (out.inside) out.cost = std::min(limit3_, out.distance2 + (variance / least).log().sum());
  return out;
}

}  // namespace field_fusion::core
