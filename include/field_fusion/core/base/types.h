#pragma once
// The plain data that all stages exchange. Lengths in metres, angles in radians, times in seconds;
// frames by REP-103 (x forward, y left, z up), azimuth counter-clockwise positive.
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace field_fusion::core {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Ring of a point whose sensor row is not known.
constexpr std::uint16_t kUnknownRing = 0xffff;

/// One LiDAR return in the sensor's frame. What a driver does not send is NaN, or kUnknownRing.
struct Point {
  float x = 0.f, y = 0.f, z = 0.f;    ///< [m]
  float intensity = kNaN;             ///< as the sensor scales it
  float time = kNaN;                  ///< [s] after the cloud's stamp; may be negative
  std::uint16_t ring = kUnknownRing;  ///< sensor row, 0 is the lowest
  std::uint16_t unused = 0;           ///< keeps the layout free of uninitialised bytes

  Eigen::Vector3f position() const { return {x, y, z}; }
};
static_assert(sizeof(Point) == 24, "Point goes to the wire as it lies in memory");

using Cloud = std::vector<Point>;

/// Rigid motion that carries coordinates of frame `source` into frame `target`:
/// p_target = T_target_source * p_source. Variables are named after both frames.
using Transform = Eigen::Isometry3d;

/// An interval of points in some index list or array.
struct IndexRange {
  std::uint32_t first = 0, count = 0;
};

/// Polar coordinates of a position seen from the frame's origin.
struct Polar {
  double range = 0.0;      ///< [m] slant range, Euclidean
  double azimuth = 0.0;    ///< [rad] counter-clockwise from x
  double elevation = 0.0;  ///< [rad] up from the x-y plane
};

inline Polar polar(const Eigen::Vector3d& p) {
  return {p.norm(), std::atan2(p.y(), p.x()), std::atan2(p.z(), p.head<2>().norm())};
}

inline Eigen::Vector3d cartesian(const Polar& p) {
  const double flat = p.range * std::cos(p.elevation);
  return {flat * std::cos(p.azimuth), flat * std::sin(p.azimuth), p.range * std::sin(p.elevation)};
}

constexpr double radians(double degrees) { return degrees * (3.14159265358979323846 / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / 3.14159265358979323846); }

/// Smallest signed difference a - b of two angles [rad], in [-pi, pi].
inline double angleDifference(double a, double b) { return std::remainder(a - b, 2.0 * radians(180.0)); }

}  // namespace field_fusion::core
