#include "field_fusion/core/sim/truth.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "polyhedron.h"
#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

/// The part of a convex polygon in which sign * axis <= sign * limit, borders included.
Polygon clipped(const Polygon& in, int axis, double sign, double limit) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Eigen::Vector3d &a = in[i], &b = in[(i + 1) % in.size()];
    const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
    if (da <= 0) out.push_back(a);
    if (da * db < 0) out.push_back(a + da / (da - db) * (b - a));
  }
  return out;
}

constexpr double kTouch = 1e-5;  // [m] what lies on a border is in both cells, whatever the rounding

/// Marks every cell that the convex polygon, seen from above, touches.
void mark(const Polygon& polygon, TruthGrid& grid) {
  if (polygon.empty()) return;
  const auto place = [&grid](double value, int axis, int count) {
    return std::clamp(static_cast<int>(std::floor((value - grid.origin[axis]) / grid.cell)), 0, count - 1);
  };
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : polygon) box.extend(p);
  for (int row = place(box.min().y() - kTouch, 1, grid.rows);
       row <= place(box.max().y() + kTouch, 1, grid.rows); ++row) {
    const double south = grid.origin.y() + row * grid.cell;
    Eigen::AlignedBox3d strip;
    for (const Eigen::Vector3d& p :
         clipped(clipped(polygon, 1, -1, south - kTouch), 1, 1, south + grid.cell + kTouch))
      strip.extend(p);
    if (strip.isEmpty()) continue;
    const int last = place(strip.max().x() + kTouch, 0, grid.columns);
    for (int column = place(strip.min().x() - kTouch, 0, grid.columns); column <= last; ++column)
      grid.occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                    static_cast<std::size_t>(column)] = 1;
  }
}

Eigen::AlignedBox3d boxAt(const Model& model, double time, const Transform& T) {
  Model frozen;
  for (std::size_t i = 0; i < model.links.size(); ++i)
    for (Link& link : moved({{{model.links[i].parts, {}}}}, T * model.linkPose(i, time)).links)
      frozen.links.push_back(std::move(link));
  return frozen.box();
}

bool swings(const Model& model) {
  return std::any_of(model.links.begin(), model.links.end(),
                     [](const Link& link) { return link.joint.has_value(); });
}

TruthGrid emptyGrid(const World& world, double time, const SliceParams& slice) {
  if (!(slice.cell > 0)) throw std::invalid_argument("cell must be above 0");
  if (!(slice.low <= slice.high)) throw std::invalid_argument("low must not be above high");
  TruthGrid grid;
  grid.cell = slice.cell;
  Eigen::AlignedBox3d all;
  for (const Body& body : world.bodies) all.extend(boxAt(body.model, time, body.way.pose(time)));
  if (all.isEmpty()) return grid;
  grid.origin = ((all.min().head<2>().array() - slice.margin) / slice.cell).floor() * slice.cell;
  const Eigen::Array2d cells =
      (((all.max().head<2>() - grid.origin).array() + slice.margin) / slice.cell).ceil();
  if (!(cells.prod() <= 1e8)) throw std::invalid_argument("the map would have more than 1e8 cells");
  grid.columns = static_cast<int>(cells.x());
  grid.rows = static_cast<int>(cells.y());
  grid.occupied.assign(static_cast<std::size_t>(cells.prod()), 0);
  return grid;
}

}  // namespace

bool TruthGrid::at(const Eigen::Vector2d& place) const {
  const Eigen::Array2d p = ((place - origin) / cell).array().floor();
  if (!(p.x() >= 0 && p.y() >= 0 && p.x() < columns && p.y() < rows)) return false;
  return at(static_cast<int>(p.x()), static_cast<int>(p.y()));
}

std::vector<TruthBox> truthAt(const World& world, double time) {
  std::vector<TruthBox> out;
  for (const Body& body : world.bodies) {
    const Transform T_world_body = body.way.pose(time);
    const Eigen::AlignedBox3d box =
        swings(body.model) ? boxAt(body.model, time, Transform::Identity()) : body.model.box();
    out.push_back({body.name, body.label, T_world_body, T_world_body * Eigen::Translation3d(box.center()),
                   box.sizes()});
  }
  return out;
}

TruthGrid occupancy(const World& world, double time, const SliceParams& slice) {
  TruthGrid grid = emptyGrid(world, time, slice);
  if (grid.occupied.empty()) return grid;
  for (const Body& body : world.bodies) {
    const Transform T_world_body = body.way.pose(time);
    for (std::size_t i = 0; i < body.model.links.size(); ++i) {
      const Transform T = T_world_body * body.model.linkPose(i, time);
      for (const Part& part : body.model.links[i].parts) {
        const Mesh mesh = polyhedron(part.shape);
        for (const auto& [a, b, c] : mesh.triangles) {
          Polygon polygon;
          for (const auto corner : {a, b, c}) polygon.push_back(T * mesh.vertices[corner].cast<double>());
          mark(clipped(clipped(polygon, 2, -1, slice.low - kTouch), 2, 1, slice.high + kTouch), grid);
        }
      }
    }
  }
  return grid;
}

}  // namespace field_fusion::core::sim
