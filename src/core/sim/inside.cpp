#include <algorithm>
#include <cmath>

#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

/// Crossings of the ray from `p` along `d` with the triangles (Moeller and Trumbore).
int crossings(const Mesh& mesh, const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
  int count = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[i].cast<double>();
    const Eigen::Vector3d ab = mesh.vertices[j].cast<double>() - a, ac = mesh.vertices[k].cast<double>() - a;
    const Eigen::Vector3d n = d.cross(ac), ap = p - a;
    const double det = ab.dot(n);
    if (det == 0) continue;
    const double u = ap.dot(n) / det, v = d.dot(ap.cross(ab)) / det;
    count += u >= 0 && v >= 0 && u + v <= 1 && ac.dot(ap.cross(ab)) / det > 0;
  }
  return count;
}

struct Holds {
  const Eigen::Vector3d& p;

  bool operator()(const Mesh& mesh) const {
    // an open mesh, such as a wall of one sheet, is crossed in some directions only
    for (const Eigen::Vector3d& d :
         {Eigen::Vector3d(1, 0.13, 0.07), Eigen::Vector3d(-0.11, 1, 0.05), Eigen::Vector3d(0.09, -0.06, 1)})
      if (crossings(mesh, p, d) % 2 == 0 || crossings(mesh, p, -d) % 2 == 0) return false;
    return true;
  }
  bool operator()(const Sphere& s) const { return (p - s.centre.cast<double>()).norm() < s.radius; }
  bool operator()(const Cylinder& c) const {
    const Eigen::Vector3d axis = c.axis.cast<double>(), from_foot = p - c.foot.cast<double>();
    const double along = from_foot.dot(axis) / axis.squaredNorm();
    return along > 0 && along < 1 && (from_foot - along * axis).norm() < c.radius;
  }
};

struct Move {
  const Eigen::Affine3f& T;
  float scale;  // that is in T

  void operator()(Mesh& mesh) const {
    for (Eigen::Vector3f& vertex : mesh.vertices) vertex = T * vertex;
  }
  void operator()(Sphere& sphere) const {
    sphere.centre = T * sphere.centre;
    sphere.radius *= scale;
  }
  void operator()(Cylinder& cylinder) const {
    cylinder.foot = T * cylinder.foot;
    cylinder.axis = T.linear() * cylinder.axis;
    cylinder.radius *= scale;
  }
};

/// T turns, moves and makes `scale` times as large.
Model changed(Model model, const Eigen::Affine3d& T, double scale) {
  const Eigen::Affine3f Tf = T.cast<float>();
  for (Link& link : model.links) {
    for (Part& part : link.parts) std::visit(Move{Tf, static_cast<float>(scale)}, part.shape);
    if (!link.joint) continue;
    link.joint->pivot = T * link.joint->pivot;
    link.joint->axis = T.linear() * link.joint->axis / scale;
    link.joint->period *= scale;
  }
  return model;
}

}  // namespace

bool inside(const Model& model, const Eigen::Vector3d& point, double time) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Eigen::Vector3d p = model.linkPose(i, time).inverse() * point;
    for (const Part& part : model.links[i].parts)
      if (std::visit(Holds{p}, part.shape)) return true;
  }
  return false;
}

Model moved(Model model, const Transform& T_body_model) {
  return changed(std::move(model), Eigen::Affine3d(T_body_model), 1.0);
}

Model scaled(Model model, double factor, double foot) {
  const Eigen::Translation3d up(0.0, 0.0, foot);
  return changed(std::move(model), up * Eigen::Scaling(factor) * up.inverse(), factor);
}

}  // namespace field_fusion::core::sim
