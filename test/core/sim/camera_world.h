#pragma once
// What the tests of the colour camera share.
#include "field_fusion/core/sim/colour_camera.h"
#include "test_world.h"

namespace field_fusion::core::sim::test {

/// 640 x 480, focal length 500 px, no faults, exposure such that radiance 1 is white.
inline CameraParams plainCamera() {
  CameraParams p;
  p.fx = p.fy = 500.0, p.cx = 319.5, p.cy = 239.5;
  p.auto_exposure = p.noise = p.reflections = false;
  p.vignetting = p.glare = 0.0;
  p.exposure_time = p.white_time = 2.0;
  return p;
}

/// The same view with a quarter of the pixels along each side.
inline CameraParams smallCamera() {
  CameraParams p = plainCamera();
  p.width = 160, p.height = 120;
  p.fx = p.fy = 125.0, p.cx = 79.5, p.cy = 59.5;
  return p;
}

/// One picture of a camera at rest.
inline ColourFrame shoot(const World& world, const CameraParams& params, const Transform& T_world_sensor,
                         double stamp = 0.0, std::uint64_t seed = 1) {
  Caster caster(world);
  ColourCamera camera(params, world, seed);
  return camera.run(
      caster, [&](double) { return T_world_sensor; }, stamp);
}

/// Stands at a height and looks along x, turned to the left and then down by angles [rad].
inline Transform lookFrom(const Eigen::Vector3d& at, double left = 0.0, double down = 0.0) {
  Transform T = Transform::Identity();
  T.translate(at);
  T.rotate(Eigen::AngleAxisd(left, Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(down, Eigen::Vector3d::UnitY()));
  return T;
}

/// A wall across x = 10 m that fills the view.
inline World wallWorld(float grey) {
  Cylinder wall{{10.f, 0.f, 0.f}, {1.f, 0.f, 0.f}, 100.f};
  World world = worldOf(wall);
  world.bodies[0].model.links[0].parts[0].material.colour.setConstant(grey);
  return world;
}

/// Inverse of sRGB (IEC 61966-2-1).
inline double linearOf(double value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline double brightness(const cv::Vec3b& pixel) {
  return 0.2126 * linearOf(pixel[0]) + 0.7152 * linearOf(pixel[1]) + 0.0722 * linearOf(pixel[2]);
}

}  // namespace field_fusion::core::sim::test
