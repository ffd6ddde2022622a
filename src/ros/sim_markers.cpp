#include "field_fusion/ros/sim_markers.h"

#include <tf2_eigen/tf2_eigen.h>
#include <boost/make_shared.hpp>

#include <algorithm>

#include "field_fusion/ros/marker_shapes.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_output.h"

namespace field_fusion {
namespace {

namespace sim = core::sim;
using visualization_msgs::Marker;

constexpr double kMaxGround = 150.0;  // m, of the piece of ground that is drawn
constexpr int kGroundCells = 80;      // along each side, where it is not flat
const std::string kWorld = "world";

/// A link that does not stay where it is in `frame`, on a body that moves or does not.
bool moves(const sim::Model& model, const sim::Trajectory* way, std::size_t link) {
  if (way && !way->still()) return true;
  if (model.links[link].joint) return true;
  const int parent = model.links[link].parent;
  return parent >= 0 && moves(model, nullptr, static_cast<std::size_t>(parent));
}

std::string frameOf(const std::string& body, std::size_t link) {
  return "truth/" + body + "/" + std::to_string(link);
}

std_msgs::ColorRGBA colourOf(const sim::Material& material) {
  const Eigen::Vector4f shown = sim::shownColour(material);
  std_msgs::ColorRGBA colour;
  colour.r = shown[0], colour.g = shown[1], colour.b = shown[2];
  // RViz draws what is not opaque in the order of its triangles: backs, which are black, come over fronts
  colour.a = material.transparency < 0.5f ? 1.f : shown[3];
  return colour;
}

/// Fills in what each shape needs of a marker whose pose is that of the link.
struct Drawn {
  Marker& marker;
  core::Transform T;  // T_frame_link

  void operator()(const sim::Mesh& mesh) {
    marker.type = Marker::TRIANGLE_LIST;
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    for (const auto& triangle : mesh.triangles)
      for (const auto corner : triangle)
        marker.points.push_back(pointOf(mesh.vertices[corner].cast<double>()));
    marker.pose = tf2::toMsg(T);
  }
  void operator()(const sim::Sphere& sphere) {
    marker.type = Marker::SPHERE;
    marker.scale.x = marker.scale.y = marker.scale.z = 2.0 * static_cast<double>(sphere.radius);
    marker.pose = tf2::toMsg(core::Transform(T * Eigen::Translation3d(sphere.centre.cast<double>())));
  }
  void operator()(const sim::Cylinder& cylinder) {
    marker.type = Marker::CYLINDER;
    marker.scale.x = marker.scale.y = 2.0 * static_cast<double>(cylinder.radius);
    marker.scale.z = static_cast<double>(cylinder.axis.norm());
    marker.pose = tf2::toMsg(core::Transform(T * sim::frameOf(cylinder)));
  }
};

class Drawing {
 public:
  explicit Drawing(Marks marks) : marks_(marks) {}

  Marker& add(const std::string& layer, const std::string& frame, const sim::Material& material) {
    Marker& marker = array_->markers.emplace_back();
    marker.header.frame_id = frame;
    marker.header.stamp = ros::Time();  // by RViz: whatever frame is known last
    marker.ns = layer;
    marker.id = static_cast<int>(array_->markers.size());
    marker.action = Marker::ADD;
    marker.frame_locked = true;
    marker.color = colourOf(material);
    return marker;
  }
  void add(const std::string& layer, const std::string& name, const std::string& fixed,
           const sim::Model& model, const sim::Trajectory* way) {
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      const bool own = moves(model, way, i);
      if ((own || fixed != kWorld) != (marks_ == Marks::kMoving)) continue;
      core::Transform T = core::Transform::Identity();
      if (!own) T = (way ? way->pose(0.0) : T) * model.linkPose(i, 0.0);
      for (const sim::Part& part : model.links[i].parts)
        std::visit(Drawn{add(layer, own ? frameOf(name, i) : fixed, part.material), T}, part.shape);
    }
  }
  boost::shared_ptr<visualization_msgs::MarkerArray> take() { return array_; }

 private:
  Marks marks_;
  boost::shared_ptr<visualization_msgs::MarkerArray> array_ =
      boost::make_shared<visualization_msgs::MarkerArray>();
};

/// Over what the bodies and the robot need, as it is at the start.
void addGround(const sim::World& world, Drawing& drawing) {
  if (world.ground.kind == sim::Ground::Kind::kNone) return;
  Eigen::AlignedBox2d area(world.robot.way.pose(0.0).translation().head<2>());
  for (const sim::Body& body : world.bodies)
    area.extend(Eigen::Vector2d(body.way.pose(0.0).translation().head<2>()));
  const Eigen::Vector2d low = (area.min().array() - 8.0).max(-kMaxGround).matrix();
  const Eigen::Vector2d high = (area.max().array() + 8.0).min(kMaxGround).matrix();
  const int cells = world.ground.kind == sim::Ground::Kind::kPlane ? 1 : kGroundCells;
  const auto corner = [&](int i, int j) {
    const Eigen::Vector2d p = low + (high - low).cwiseProduct(Eigen::Vector2d(i, j)) / cells;
    return pointOf({p.x(), p.y(), world.ground.height(p.x(), p.y(), 0.0)});
  };
  Marker& marker = drawing.add("ground", kWorld, world.ground.material);
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.pose.orientation.w = 1.0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (const auto& [di, dj] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 0},
                                   std::pair{1, 1}, std::pair{0, 1}})
        marker.points.push_back(corner(i + di, j + dj));
}

void addFrames(const std::string& name, const std::string& parent, const sim::Model& model,
               const sim::Trajectory* way, double time,
               std::vector<geometry_msgs::TransformStamped>& frames) {
  const core::Transform T = way ? way->pose(time) : core::Transform::Identity();
  for (std::size_t i = 0; i < model.links.size(); ++i)
    if (!model.links[i].parts.empty() && moves(model, way, i))
      frames.push_back(
          transformMessage(simTime(time), parent, frameOf(name, i), T * model.linkPose(i, time)));
}

}  // namespace

boost::shared_ptr<visualization_msgs::MarkerArray> worldMarkers(const sim::World& world, Marks marks) {
  Drawing drawing(marks);
  if (marks == Marks::kStanding) addGround(world, drawing);
  for (const sim::Body& body : world.bodies)
    drawing.add(body.label.empty() ? "surroundings" : body.label, body.name, kWorld, body.model, &body.way);
  drawing.add("robot", "robot", "base", world.robot.model, nullptr);
  return drawing.take();
}

std::vector<geometry_msgs::TransformStamped> linkFrames(const sim::World& world, double time) {
  std::vector<geometry_msgs::TransformStamped> frames;
  for (const sim::Body& body : world.bodies)
    addFrames(body.name, kWorld, body.model, &body.way, time, frames);
  addFrames("robot", "base", world.robot.model, nullptr, time, frames);
  return frames;
}

}  // namespace field_fusion
