#include "field_fusion/core/sim/urdf.h"

#include <array>
#include <optional>
#include <sstream>

#include "field_fusion/core/sim/lens.h"
#include "field_fusion/core/sim/sensor_models.h"

namespace field_fusion::core::sim {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto at = std::string("&<>\"").find(c);
    out += at == std::string::npos ? std::string(1, c)
                                   : std::array<const char*, 4>{"&amp;", "&lt;", "&gt;", "&quot;"}[at];
  }
  return out;
}

/// About fixed axes, as URDF has them. Looking straight up or down, all of the turn is yaw.
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& R) {
  const double level = std::hypot(R(2, 1), R(2, 2)), pitch = std::atan2(-R(2, 0), level);
  if (level < 1e-9) return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

/// Of edges a, b, c from one corner, as boxMesh lays it out.
struct Box {
  Transform T_mesh_box;  // of its middle
  Eigen::Vector3d size;
};

std::optional<Box> boxOf(const Mesh& mesh) {
  const auto& v = mesh.vertices;
  constexpr std::size_t kCorners = 8, kMiddles = 2;
  if (v.size() != kCorners + kMiddles) return {};
  const Eigen::Vector3f a = v[1] - v[0], b = v[3] - v[0], c = v[4] - v[0];
  const float slack = 1e-4f * (a + b + c).norm();
  const std::array<Eigen::Vector3f, kCorners> corners{
      v[0], v[0] + a, v[0] + a + b, v[0] + b, v[0] + c, v[0] + a + c, v[0] + a + b + c, v[0] + b + c};
  for (std::size_t i = 0; i < kCorners; ++i)
    if ((v[i] - corners[i]).norm() > slack) return {};
  for (const auto& [s, t] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
    if (std::abs(s.normalized().dot(t.normalized())) > 1e-4f) return {};
  Transform T_mesh_box = Transform::Identity();
  T_mesh_box.linear() << a.normalized().cast<double>(), b.normalized().cast<double>(),
      a.cross(b).normalized().cast<double>();
  T_mesh_box.translation() = (v[0] + 0.5f * (a + b + c)).cast<double>();
  return Box{T_mesh_box, {a.norm(), b.norm(), c.norm()}};
}

class Writer {
 public:
  void origin(const Transform& T) {
    out_ << "<origin xyz=\"";
    numbers(T.translation());
    out_ << "\" rpy=\"";
    numbers(rollPitchYaw(T.linear()));
    out_ << "\"/>";
  }
  void joint(const std::string& parent, const std::string& child, const Transform& T_parent_child) {
    out_.precision(12);  // /tf_static must be what the file says
    out_ << "  <link name=\"" << escaped(child) << "\"/>\n  <joint name=\"" << escaped(child)
         << "_joint\" type=\"fixed\"><parent link=\"" << escaped(parent) << "\"/><child link=\""
         << escaped(child) << "\"/>";
    origin(T_parent_child);
    out_ << "</joint>\n";
  }
  void visual(const Part& part, const Transform& T_base_link) {
    out_.precision(6);
    out_ << "    <visual>";
    std::visit([&](const auto& shape) { geometry(shape, T_base_link); }, part.shape);
    out_ << "<material name=\"part_" << ++parts_ << "\"><color rgba=\"";
    numbers(shownColour(part.material));
    out_ << "\"/></material></visual>\n";
  }
  std::ostringstream& text() { return out_; }

 private:
  template <class Vector>
  void numbers(const Vector& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) out_ << (i ? " " : "") << values[i] + 0;  // -0 is 0
  }
  void box(const Transform& T, const Eigen::Vector3d& size) {
    origin(T);
    out_ << "<geometry><box size=\"";
    numbers(size);
    out_ << "\"/></geometry>";
  }
  void geometry(const Mesh& mesh, const Transform& T_base_link) {
    if (const auto exact = boxOf(mesh)) return box(T_base_link * exact->T_mesh_box, exact->size);
    const Eigen::AlignedBox3d about = Model{{{{{mesh, {}}}, {}}}}.box();
    out_ << "<!-- the box about a mesh -->";
    box(T_base_link * Eigen::Translation3d(about.center()), about.sizes());
  }
  void geometry(const Sphere& sphere, const Transform& T_base_link) {
    origin(T_base_link * Eigen::Translation3d(sphere.centre.cast<double>()));
    out_ << "<geometry><sphere radius=\"" << sphere.radius << "\"/></geometry>";
  }
  void geometry(const Cylinder& cylinder, const Transform& T_base_link) {
    origin(T_base_link * frameOf(cylinder));
    out_ << "<geometry><cylinder radius=\"" << cylinder.radius << "\" length=\"" << cylinder.axis.norm()
         << "\"/></geometry>";
  }

  std::ostringstream out_;
  int parts_ = 0;
};

}  // namespace

std::string urdf(const World& world, const std::string& sensors) {
  const Robot& robot = world.robot;
  Writer writer;
  writer.text() << "<?xml version=\"1.0\"?>\n<robot name=\"" << escaped(robot.name) << "\">\n";
  writer.text() << "  <link name=\"base\">\n";
  for (std::size_t i = 0; i < robot.model.links.size(); ++i)
    for (const Part& part : robot.model.links[i].parts) writer.visual(part, robot.model.linkPose(i, 0.0));
  writer.text() << "  </link>\n";
  for (const Mount& mount : robot.mounts) {
    const SensorKind& kind = sensorKind(sensors, mount.model);
    if (kind.odometry) continue;
    writer.joint("base", mount.name, mount.T_base_nominal);
    if (kind.optical) writer.joint(mount.name, mount.name + "_optical", sensorToOptical());
  }
  writer.text() << "</robot>\n";
  return writer.text().str();
}

}  // namespace field_fusion::core::sim
