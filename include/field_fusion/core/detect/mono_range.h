#pragma once
// Range from one camera: how large a body of known height looks.
#include <string>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/detect/bearing.h"
#include "field_fusion/core/detect/image_box.h"

namespace field_fusion::core {

/// Nominal heights of COCO's classes and of those of the project's own detector. Person, car and truck: the rounded means of KITTI's labels
/// (1.76, 1.53, 3.25 m; a person without shoes and backpack is nearer 1.7). Stop sign: the US
/// standard R1-1, 30 in. The others: typical of the vehicle or animal as it stands; two-wheelers
/// without rider, because COCO labels the rider as a person; what floats, from the water on.
struct RangeParams {
  Table class_heights{{"person", 1.7}, {"bicycle", 1.1}, {"motorcycle", 1.2}, {"car", 1.5},
                      {"truck", 3.2},  {"bus", 3.1},     {"train", 3.9},      {"boat", 2.5},
                      {"dog", 0.5},    {"horse", 1.7},   {"cow", 1.5},        {"sheep", 0.8},
                      {"stop sign", 0.76}, {"bench", 0.85}, {"cage", 1.0},    {"buoy", 1.6},
                      {"bollard", 0.5}, {"balloon_car", 1.35}, {"puppet", 1.5}, {"cone", 0.5},
                      {"stool", 0.5},  {"chair", 0.95}};
  double height_spread = 0.1;
  Table class_height_spreads{{"truck", 0.3}, {"boat", 0.6}, {"dog", 0.3}, {"buoy", 0.3}, {"cone", 0.3}};
  double box_pixel_error = 1.5;
  double plane_tilt_sigma = 0.5;
  double plane_height_sigma = 0.05;
  double plane_max_age = 0.5;

  void declare(Params& p) {
    p.number("class_heights", class_heights, {0.01, 100.0}, "m", When::kStart,
             "Height of a body of each class. A class that is not here gets no range.");
    p.number("height_spread", height_spread, {0.0, 2.0}, "", When::kLive,
             "Standard deviation of heights within a class over their mean.");
    p.number("class_height_spreads", class_height_spreads, {0.0, 2.0}, "", When::kStart,
             "height_spread of single classes that vary more or less than the rest.");
    p.number("box_pixel_error", box_pixel_error, {0.01, 100.0}, "px", When::kLive,
             "Standard deviation of one edge of a box, in pixels of the model's input.");
    p.number("plane_tilt_sigma", plane_tilt_sigma, {0.01, 45.0}, "deg", When::kLive,
             "Standard deviation of the ground's direction in the camera's frame: fit, mounting, pitching, "
             "shape.");
    p.number("plane_height_sigma", plane_height_sigma, {0.0, 10.0}, "m", When::kLive,
             "Standard deviation of the camera's height above the ground where the body stands.");
    p.number("plane_max_age", plane_max_age, {0.0, 60.0}, "s", When::kLive,
             "A ground plane whose stamp differs more from the image's is not used.");
  }
};

/// NaN throughout where the box does not tell.
struct MonoRange {
  double depth = kNaN;  ///< [m] along the optical axis
  double range = kNaN;  ///< [m] along the ray through the box centre
  double sigma = kNaN;  ///< [m] standard deviation of range
  double edge = kNaN;   ///< [m] the part of sigma that comes from the box's bottom edge
};

/// Paper 001 Eq. 3. Its F * h_i / H_s (focal length, image height in pixels, sensor height) is the
/// focal length f_y in pixels, so that Z = f_y * H / h_b. That is the depth Z along the optical axis of
/// an upright body before a level camera, wherever in the image it stands, and not yet its distance:
/// range = Z / ray.z. `box` is rectified [px]. Unknown where the top or bottom border cuts the box, where
/// the class has no height, and without camera model.
///
/// Sigma is first order: sqrt((sqrt(2) e / h_b)^2 + spread^2) * range with the edge error e in pixels of
/// the image. The error of the ray is left out: at most h_b / (4 f) of the first term.
MonoRange rangeFromHeight(const std::string& label, const ImageBox& box, std::uint8_t cut, double input_scale,
                          const Pinhole& camera, const RangeParams& params);

}  // namespace field_fusion::core
