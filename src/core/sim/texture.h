#pragma once
// Colours of surfaces, in linear RGB.
#include "field_fusion/core/sim/model.h"

namespace field_fusion::core::sim {

/// Smooth noise of mean 1/2 within 0..1, `octaves` of it, each half as large. Those finer than `footprint`
/// (in units of the lattice) are left out.
float smoothNoise(const Eigen::Vector3f& place, int octaves, float footprint);

/// At a place in the body's frame. A pattern finer than `footprint` [m], what one pixel covers, goes over
/// into its mean.
Eigen::Vector3f colourAt(const Material& material, const Eigen::Vector3f& place, float footprint);

/// Colours of a ground are mottled, for none is of one colour: factor of mean 1.
float groundMottle(const Eigen::Vector3f& place, float footprint);

/// Brightness of a colour (ITU-R BT.709).
inline float luminance(const Eigen::Vector3f& c) { return c.dot(Eigen::Vector3f(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace field_fusion::core::sim
