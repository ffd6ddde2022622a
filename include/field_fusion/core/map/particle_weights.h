#pragma once
// Weights of a particle filter.
#include <cstddef>
#include <vector>

namespace field_fusion::core {

/// Weights that sum to 1 from unnormalised logarithms; equal where none is finite.
std::vector<double> normalised(const std::vector<double>& log_weights);

/// Particles that count, 1 / sum of squares (Grisetti et al. 2007, Eq. 20).
double effectiveNumber(const std::vector<double>& weights);

/// -sum w log w: 0 where one particle has all weight, log n where all are alike.
double entropy(const std::vector<double>& weights);

/// For each new particle the old one it comes from, in rising order: low variance resampling with one draw
/// `uniform` in [0, 1) (Thrun, Burgard and Fox 2005, Table 4.4).
std::vector<std::size_t> resampled(const std::vector<double>& weights, double uniform);

}  // namespace field_fusion::core
