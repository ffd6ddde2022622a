#include "field_fusion/core/sim/model.h"

#include <cmath>

namespace field_fusion::core::sim {
namespace {

/// Box of a disc about `axis` is flat along the axis and round across it.
Eigen::Vector3f reach(const Cylinder& c) {
  const Eigen::Vector3f unit = c.axis.normalized();
  return c.radius * (Eigen::Vector3f::Ones() - unit.cwiseAbs2()).cwiseMax(0.f).cwiseSqrt();
}

struct Corners {
  const Transform& T;
  Eigen::AlignedBox3d& box;

  void add(const Eigen::Vector3f& p) { box.extend(T * p.cast<double>()); }
  void operator()(const Mesh& mesh) {
    for (const Eigen::Vector3f& p : mesh.vertices) add(p);
  }
  void operator()(const Sphere& s) {
    const Eigen::Vector3d centre = T * s.centre.cast<double>(), r = Eigen::Vector3d::Constant(s.radius);
    box.extend(centre - r), box.extend(centre + r);
  }
  void operator()(const Cylinder& c) {
    const Eigen::Matrix3f R = T.linear().cast<float>();
    const Eigen::Vector3d r = reach({c.foot, R * c.axis, c.radius}).cast<double>();
    for (const Eigen::Vector3f& end : {c.foot, Eigen::Vector3f(c.foot + c.axis)}) {
      const Eigen::Vector3d middle = T * end.cast<double>();
      box.extend(middle - r), box.extend(middle + r);
    }
  }
};

}  // namespace

void Mesh::add(const Mesh& other, const Eigen::Isometry3f& T_this_other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Eigen::Vector3f& p : other.vertices) vertices.push_back(T_this_other * p);
  for (const auto& [a, b, c] : other.triangles) triangles.push_back({first + a, first + b, first + c});
}

Transform frameOf(const Cylinder& cylinder) {
  const Eigen::Vector3d axis = cylinder.axis.cast<double>();
  const Eigen::Vector3d middle = cylinder.foot.cast<double>() + 0.5 * axis;
  return Eigen::Translation3d(middle) * Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis);
}

Eigen::Vector4f shownColour(const Material& material) {
  const bool plain = material.texture == Material::Texture::kPlain;
  const Eigen::Vector3f mean = plain ? material.colour : 0.5f * (material.colour + material.colour2);
  Eigen::Vector4f shown;
  shown << mean.cwiseMax(0.f).cwiseMin(1.f).array().pow(1.f / 2.2f), 1.f - 0.7f * material.transparency;
  return shown;
}

Transform Joint::at(double time) const {
  const double angle = bias + amplitude * std::sin(radians(360.0) * time / period + phase);
  return Eigen::Translation3d(pivot) * Eigen::AngleAxisd(angle, axis) * Eigen::Translation3d(-pivot);
}

Transform Model::linkPose(std::size_t link, double time) const {
  const Transform T = links[link].joint ? links[link].joint->at(time) : Transform::Identity();
  const int parent = links[link].parent;
  return parent < 0 ? T : linkPose(static_cast<std::size_t>(parent), time) * T;
}

Eigen::AlignedBox3d Model::box() const {
  Model rest = *this;
  for (Link& link : rest.links)
    if (link.joint) link.joint->amplitude = 0.0;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Transform T = rest.linkPose(i, 0.0);
    for (const Part& part : links[i].parts) std::visit(Corners{T, box}, part.shape);
  }
  return box;
}

}  // namespace field_fusion::core::sim
