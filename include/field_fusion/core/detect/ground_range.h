#pragma once
// Range from one camera: where the box of a body meets the ground.
#include "field_fusion/core/cloud/plane.h"
#include "field_fusion/core/detect/mono_range.h"

namespace field_fusion::core {

/// From the middle of the box's bottom edge, for a body that stands upright on `ground`, a plane in the
/// camera's optical frame whose normal points up and whose offset is the camera's height above it. `box` is
/// rectified [px]. Range and depth are those of the body's near side on the ray through the box centre.
/// Unknown where the bottom border cuts the box, at or above the horizon, without camera model, and where
/// sigma would exceed half of the range: it is first order,
/// range * sqrt((n_y e / (f_y n.d))^2 + (|d x n| tilt / n.d)^2 + (height sigma / height)^2) with the ray d
/// through the bottom edge and the edge error e in pixels of the image.
MonoRange rangeFromGround(const ImageBox& box, std::uint8_t cut, double input_scale, const Pinhole& camera,
                          const Plane& ground, const RangeParams& params);

/// Mean of two estimates on one ray, weighted by the inverse variances; the other one where one is unknown.
/// Sigma takes into account that both used the bottom edge, and where the two lie further apart than their
/// sigmas say it grows by that factor (Birge's ratio): at least one of their premises is wrong then.
MonoRange combined(const MonoRange& a, const MonoRange& b);

}  // namespace field_fusion::core
