#pragma once
// A street as a spinning LiDAR sees it: exact ray casting of a ground plane, boxes (houses, cars) and
// upright cylinders (people, poles). The same description gives the same cloud.
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "field_fusion/core/base/types.h"

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

/// Boxes and cylinders of a street along x, the sensor at the origin.
class Street {
 public:
  Street(double height, unsigned seed) : floor_(-height), random_(seed) {
    for (double x = -90.0; x < 90.0; x += 15.0)
      for (const double side : {-1.0, 1.0}) addHouse(x, side);
    for (double x = -60.0; x < 60.0; x += 7.0)
      for (const double side : {-1.0, 1.0}) addKerbside(x, side);
    addBox({8.0, -0.9}, {12.2, 0.9}, 1.5);      // the car ahead
    addBox({-60.0, 2.0}, {-51.0, 4.5}, 3.2);    // a truck behind
    addBox({88.0, -15.0}, {95.0, 15.0}, 15.0);  // houses close both ends
    addBox({-95.0, -15.0}, {-88.0, 15.0}, 15.0);
  }

  /// [m] to the first surface along the unit direction from the origin, and whether it is the ground.
  std::pair<double, bool> cast(const Eigen::Vector3d& ray) const {
    double nearest = ray.z() < 0.0 ? floor_ / ray.z() : kNever;
    bool ground = nearest < kNever;
    const auto meet = [&](double range) {
      if (range < nearest) nearest = range, ground = false;
    };
    for (const auto& box : boxes_) meet(castBox(box, ray));
    for (const auto& cylinder : cylinders_) meet(castCylinder(cylinder, ray));
    return {nearest, ground};
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Cylinder {
    Eigen::Vector2d middle;
    double radius, top;
  };

  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void addBox(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double tall) {
    boxes_.emplace_back(Eigen::Vector3d(low.x(), low.y(), floor_),
                        Eigen::Vector3d(high.x(), high.y(), floor_ + tall));
  }

  void addHouse(double x, double side) {
    const double front = draw(8.0, 11.0), gap = draw(1.0, 6.0), tall = draw(5.0, 12.0);
    const double a = side * front, b = side * (front + 10.0);
    addBox({x, std::min(a, b)}, {x + 15.0 - gap, std::max(a, b)}, tall);
  }

  void addKerbside(double x, double side) {
    const double y = side * draw(4.0, 5.0);
    if (draw(0.0, 1.0) < 0.6) addBox({x, y - 0.9}, {x + draw(3.6, 4.8), y + 0.9}, draw(1.4, 1.9));
    cylinders_.push_back({{x + draw(5.0, 7.0), side * draw(3.0, 7.0)}, 0.25, floor_ + draw(1.6, 1.9)});
    cylinders_.push_back({{x + draw(0.0, 7.0), side * 6.8}, 0.08, floor_ + 6.0});
  }

  static double castBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& ray) {
    const Eigen::Array3d a = box.min().array() / ray.array(), b = box.max().array() / ray.array();
    const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
    return enter > 0.0 && enter <= leave ? enter : kNever;
  }

  static double castCylinder(const Cylinder& c, const Eigen::Vector3d& ray) {
    const Eigen::Vector2d d = ray.head<2>();
    const double along = c.middle.dot(d) / d.squaredNorm();
    const double half2 = (c.radius * c.radius - (c.middle - along * d).squaredNorm()) / d.squaredNorm();
    if (half2 < 0.0 || along * along < half2) return kNever;
    const double range = along - std::sqrt(half2);
    return range > 0.0 && range * ray.z() <= c.top ? range : kNever;
  }

  double floor_;
  std::mt19937 random_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Cylinder> cylinders_;
};

struct StreetClouds {
  core::Cloud all, off_ground;
};

/// Column by column, rings from low to high, as a driver sends it; a turn takes 0.1 s.
inline StreetClouds scanStreet(const StreetScan& scan = {}) {
  const Street street(scan.height, scan.seed);
  std::mt19937 random(scan.seed + 1);
  std::normal_distribution<double> noise(0.0, scan.noise);
  StreetClouds out;
  for (int column = 0; column < scan.columns; ++column)
    for (int ring = 0; ring < scan.rings; ++ring) {
      const double turn = (column + 0.5) / scan.columns;
      const double elevation = scan.elevation * (2.0 * ring / (scan.rings - 1) - 1.0);
      const Eigen::Vector3d ray = core::cartesian({1.0, core::radians(360.0) * turn, elevation});
      const auto [range, ground] = street.cast(ray);
      if (!(range < scan.max_range)) continue;
      const Eigen::Vector3f p = ((range + noise(random)) * ray).cast<float>();
      core::Point point{
          p.x(), p.y(), p.z(), 1.f, static_cast<float>(0.1 * turn), static_cast<std::uint16_t>(ring)};
      out.all.push_back(point);
      if (!ground) out.off_ground.push_back(point);
    }
  return out;
}

}  // namespace field_fusion::test
