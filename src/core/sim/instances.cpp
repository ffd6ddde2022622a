#include "instances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace field_fusion::core::sim {
namespace {

constexpr double kInstant = 0.01;        // [s] a foot that swings with 18 m/s^2 leaves its chord by 0.2 mm
constexpr unsigned kMostInstants = 129;  // Embree's limit

bool swings(const Model& model, std::size_t link) {
  const Link& l = model.links[link];
  return (l.joint && l.joint->amplitude != 0.0) ||
         (l.parent >= 0 && swings(model, static_cast<std::size_t>(l.parent)));
}

void place(RTCGeometry geometry, unsigned instant, const Affine& T) {
  const Eigen::Matrix<float, 3, 4> columns = T.matrix().cast<float>();
  rtcSetGeometryTransform(geometry, instant, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
}

void checkLinks(const Model& model) {
  for (std::size_t i = 0; i < model.links.size(); ++i)
    if (model.links[i].parent >= static_cast<int>(i))
      throw std::invalid_argument("a link is carried by a later one");
}

}  // namespace

Affine Instance::worldToLink(float time) const {
  if (T_world_link.empty() || frozen) return T_link_world;
  const auto last = static_cast<float>(T_world_link.size() - 1);
  const float at = std::clamp(time, 0.f, 1.f) * last;
  const float before = std::min(std::floor(at), last - 1.f);
  const double share = static_cast<double>(at - before);
  const auto i = static_cast<std::size_t>(before);
  Affine mixed;
  mixed.matrix() = (1.0 - share) * T_world_link[i].matrix() + share * T_world_link[i + 1].matrix();
  return mixed.inverse();
}

Instances::Instances(const World& world, RTCDevice device, RTCScene scene)
    : world_(world), device_(device), scene_(scene), scenes_(device) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    try {
      add(body.model, body.way, static_cast<int>(i));
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument("body " + body.name + ": " + fault.what());
    }
  }
  try {
    add(world.robot.model, world.robot.way, Hit::kRobot);
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("robot " + world.robot.name + ": " + fault.what());
  }
}

void Instances::add(const Model& model, const Trajectory& way, int body) {
  checkLinks(model);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.parts.empty()) continue;
    const Geometry geometry(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE));
    const RTCScene scene = scenes_.of(link);
    rtcSetGeometryInstancedScene(geometry.get(), scene);
    const Transform T_world_link = way.pose(0.0) * model.linkPose(i, 0.0);
    Instance instance{&link, body, i, scene, geometry.get(), Affine(T_world_link.inverse()), {}};
    if (!way.still() || swings(model, i)) instance.T_world_link.assign(2, Affine(T_world_link));
    place(geometry.get(), 0, Affine(T_world_link));
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_, geometry.get(), static_cast<unsigned>(list_.size()));
    list_.push_back(std::move(instance));
  }
}

std::pair<unsigned, unsigned> Instances::of(int body) const {
  // in the order of the world's bodies, the robot last
  const auto order = [](int b) { return b == Hit::kRobot ? std::numeric_limits<int>::max() : b; };
  const auto before = [&](const Instance& i, int b) { return order(i.body) < order(b); };
  const auto after = [&](int b, const Instance& i) { return order(b) < order(i.body); };
  const auto first = std::lower_bound(list_.begin(), list_.end(), body, before);
  const auto last = std::upper_bound(first, list_.end(), body, after);
  return {static_cast<unsigned>(first - list_.begin()), static_cast<unsigned>(last - list_.begin())};
}

bool Instances::setWindow(double begin, double end) {
  const double pieces = std::clamp(std::ceil((end - begin) / kInstant), 1.0, kMostInstants - 1.0);
  const auto instants = static_cast<unsigned>(pieces) + 1;
  std::vector<Transform> bodies(instants);
  int known = Hit::kNothing;  // the body whose poses these are; its links follow each other
  bool moved = false;
  for (Instance& instance : list_) {
    if (instance.T_world_link.empty()) continue;
    const bool robot = instance.body == Hit::kRobot;
    const Trajectory& way =
        robot ? world_.robot.way : world_.bodies[static_cast<std::size_t>(instance.body)].way;
    const Model& model =
        robot ? world_.robot.model : world_.bodies[static_cast<std::size_t>(instance.body)].model;
    instance.T_world_link.resize(instants);
    rtcSetGeometryTimeStepCount(instance.geometry, instants);
    for (unsigned i = 0; i < instants; ++i) {
      const double time = begin + (end - begin) * i / (instants - 1);
      if (instance.body != known) bodies[i] = way.pose(time);
      instance.T_world_link[i] = Affine(bodies[i] * model.linkPose(instance.place, time));
      place(instance.geometry, i, instance.T_world_link[i]);
    }
    instance.frozen = begin == end;
    if (instance.frozen) instance.T_link_world = instance.T_world_link[0].inverse();
    known = instance.body;
    rtcCommitGeometry(instance.geometry);
    moved = true;
  }
  return moved;
}

}  // namespace field_fusion::core::sim
