#include "ground_cast.h"

#include <algorithm>
#include <limits>

namespace field_fusion::core::sim {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

/// Of all lines: there is nothing to save.
void GroundCast::meetPlane(const LineLanes& lines, MeetingLanes& out) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double above =
        lines.origin[2][i] - ground_.slope.x() * lines.origin[0][i] - ground_.slope.y() * lines.origin[1][i];
    const double rate = lines.direction[2][i] - ground_.slope.x() * lines.direction[0][i] -
                        ground_.slope.y() * lines.direction[1][i];
    const double t = -above / rate;
    out.range[i] = t > 0.0 ? t : kFar;
    out.slope_x[i] = ground_.slope.x(), out.slope_y[i] = ground_.slope.y();
  }
}

void GroundCast::bounds(const LineLanes& lines, BoundLanes& out) const {
  if (ground_.kind == Ground::Kind::kWater) return water_.bounds(lines, out);
  MeetingLanes exact;
  meet(lines, {}, exact);
  out.enter = out.leave = exact.range;
}

void GroundCast::meet(const LineLanes& lines, const Lanes<double>& wanted, MeetingLanes& out) const {
  if (ground_.kind == Ground::Kind::kWater) return water_.meet(lines, wanted, out);
  if (ground_.kind == Ground::Kind::kPlane) return meetPlane(lines, out);
  std::fill(out.range.of, out.range.of + kLanes, kFar);
}

Mesh roughMesh(const Ground& ground) {
  const double width = 2.0 * ground.half_extent;
  const auto cells =
      static_cast<std::uint32_t>(std::clamp(std::ceil(width / (ground.grain / 8.0)), 1.0, 768.0));
  const std::uint32_t row = cells + 1;
  Mesh mesh;
  mesh.vertices.reserve(row * row), mesh.triangles.reserve(2 * cells * cells);
  for (std::uint32_t j = 0; j < row; ++j)
    for (std::uint32_t i = 0; i < row; ++i) {
      const double x = width * i / cells - ground.half_extent, y = width * j / cells - ground.half_extent;
      mesh.vertices.push_back(Eigen::Vector3d(x, y, ground.height(x, y, 0.0)).cast<float>());
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      mesh.triangles.push_back({a, b, d}), mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

}  // namespace field_fusion::core::sim
