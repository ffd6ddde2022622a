#pragma once
// A street of houses, cars, people and poles as a spinning LiDAR sees it. The same seed gives the same cloud.
#include <algorithm>
#include <random>
#include <vector>

#include "field_fusion/core/base/types.h"
#include "support/scene.h"

namespace field_fusion::test {

struct StreetScan {
  int rings = 16;
  int columns = 1800;
  double elevation = core::radians(15.0);  ///< [rad] of the highest ring; the lowest has its negative
  double height = 1.8;                     ///< [m] of the sensor above the ground
  double noise = 0.02;                     ///< [m] standard deviation of the range
  double max_range = 100.0;                ///< [m] farther returns are lost
  unsigned seed = 2;
};

/// A street along x with the sensor's foot at the origin.
class StreetBuilder {
 public:
  explicit StreetBuilder(unsigned seed) : random_(seed) {
    for (double x = -90.0; x < 90.0; x += 15.0)
      for (const double side : {-1.0, 1.0}) addHouse(x, side);
    for (double x = -60.0; x < 60.0; x += 7.0)
      for (const double side : {-1.0, 1.0}) addKerbside(x, side);
    addBox({8.0, -0.9}, {12.2, 0.9}, 1.5);      // the car ahead
    addBox({-60.0, 2.0}, {-51.0, 4.5}, 3.2);    // a truck behind
    addBox({88.0, -15.0}, {95.0, 15.0}, 15.0);  // houses close both ends
    addBox({-95.0, -15.0}, {-88.0, 15.0}, 15.0);
  }
  const Scene& scene() const { return scene_; }

 private:
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void addBox(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double tall) {
    Body body;
    body.size << high - low, tall;
    body.middle = 0.5 * (low + high);
    scene_.push_back(body);
  }

  void addCylinder(const Eigen::Vector2d& middle, double radius, double tall) {
    Body body;
    body.shape = Body::Shape::kCylinder;
    body.size << 2.0 * radius, 2.0 * radius, tall;
    body.middle = middle;
    scene_.push_back(body);
  }

  void addHouse(double x, double side) {
    const double front = draw(8.0, 11.0), gap = draw(1.0, 6.0), tall = draw(5.0, 12.0);
    const double a = side * front, b = side * (front + 10.0);
    addBox({x, std::min(a, b)}, {x + 15.0 - gap, std::max(a, b)}, tall);
  }

  void addKerbside(double x, double side) {
    const double y = side * draw(4.0, 5.0);
    if (draw(0.0, 1.0) < 0.6) addBox({x, y - 0.9}, {x + draw(3.6, 4.8), y + 0.9}, draw(1.4, 1.9));
    addCylinder({x + draw(5.0, 7.0), side * draw(3.0, 7.0)}, 0.25, draw(1.6, 1.9));
    addCylinder({x + draw(0.0, 7.0), side * 6.8}, 0.08, 6.0);
  }

  std::mt19937 random_;
  Scene scene_;
};

struct StreetClouds {
  core::Cloud all, off_ground;
};

/// Column by column, rings from low to high, as a driver sends it; a turn takes 0.1 s.
inline StreetClouds scanStreet(const StreetScan& scan = {}) {
  const StreetBuilder street(scan.seed);
  const Eigen::Vector3d sensor(0.0, 0.0, scan.height);
  std::mt19937 random(scan.seed + 1);
  std::normal_distribution<double> noise(0.0, scan.noise);
  StreetClouds out;
  for (int column = 0; column < scan.columns; ++column)
    for (int ring = 0; ring < scan.rings; ++ring) {
      const double turn = (column + 0.5) / scan.columns;
      const double elevation = scan.elevation * (2.0 * ring / (scan.rings - 1) - 1.0);
      const Eigen::Vector3d ray = core::cartesian({1.0, core::radians(360.0) * turn, elevation});
      const Hit hit = cast(street.scene(), sensor, ray);
      if (!(hit.range < scan.max_range)) continue;
      const Eigen::Vector3f p = ((hit.range + noise(random)) * ray).cast<float>();
      core::Point point{
          p.x(), p.y(), p.z(), 1.f, static_cast<float>(0.1 * turn), static_cast<std::uint16_t>(ring)};
      out.all.push_back(point);
      if (hit.body != Hit::kGround) out.off_ground.push_back(point);
    }
  return out;
}

}  // namespace field_fusion::test
