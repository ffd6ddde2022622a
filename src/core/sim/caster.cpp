#include "field_fusion/core/sim/caster.h"

#include <cmath>
#include <stdexcept>

#include "ground_cast.h"
#include "instances.h"
#include "packet.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

Line lineOf(const Ray& ray) { return {ray.origin.cast<double>(), ray.direction.cast<double>()}; }

struct Context : RTCIntersectContext {
  Context() {
    rtcInitIntersectContext(this);
    flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
};

bool seesThrough(const World& world) {
  const auto through = [](const Model& model) {
    for (const Link& link : model.links)
      for (const Part& part : link.parts)
        if (part.material.transparency > 0.f) return true;
    return false;
  };
  for (const Body& body : world.bodies)
    if (through(body.model)) return true;
  return through(world.robot.model);
}

}  // namespace

struct Caster::Scene {
  const World& world;
  Device device = newDevice();
  SceneHandle top{rtcNewScene(device.get())};
  Instances instances;
  GroundCast ground;
  Part rough;                         ///< mesh of a rough ground
  bool numbered;                      ///< whether rays need numbers
  double begin = kNaN, length = 0.0;  ///< [s] of the window; NaN: none yet

  explicit Scene(const World& w)
      : world(w), instances(w, device.get(), top.get()), ground(w.ground), numbered(seesThrough(w)) {
    rtcSetSceneFlags(top.get(), RTC_SCENE_FLAG_ROBUST);
    if (w.ground.kind != Ground::Kind::kRough) return;
    rough.shape = roughMesh(w.ground);
    checkShape(rough.shape);
    attach(device.get(), top.get(), static_cast<unsigned>(instances.size()), rough);
  }

  Hit groundHit(const Ray& ray, const MeetingLanes& meeting, std::size_t lane) const {
    const Line line = lineOf(ray);
    const Eigen::Vector3d up =
        Eigen::Vector3d(-meeting.slope_x[lane], -meeting.slope_y[lane], 1.0).normalized();
    const Eigen::Vector3d towards = up.dot(line.direction) > 0.0 ? -up : up;
    return {static_cast<float>(meeting.range[lane]), Hit::kGround, towards.cast<float>(),
            line.at(meeting.range[lane]).cast<float>(), &world.ground.material};
  }

  Hit partHit(const Ray& ray, const RTCRayHit8& found, std::size_t lane) const {
    const unsigned number = found.hit.instID[0][lane];
    const bool instanced = number != RTC_INVALID_GEOMETRY_ID;
    const Instance* instance = instanced ? &instances[number] : nullptr;
    const Part& part = instanced ? instance->link->parts[found.hit.geomID[lane]] : rough;
    const Affine T = instanced ? instance->worldToLink(ray.time) : Affine::Identity();
    const Line world_line = lineOf(ray), line{T * world_line.origin, T.linear() * world_line.direction};
    const Cut c = cut(line, part.shape, found.hit.primID[lane], static_cast<double>(found.ray.tfar[lane]));
    const Eigen::Vector3d out = (T.linear().transpose() * c.normal).normalized();
    const Eigen::Vector3d towards = out.dot(world_line.direction) > 0.0 ? -out : out;
    return {static_cast<float>(c.t), instanced ? instance->body : Hit::kGround, towards.cast<float>(),
            line.at(c.t).cast<float>(), instanced ? &part.material : &world.ground.material};
  }

  /// `intersect` is called once rays end where the ground surely is. Water is looked for only where what that
  /// finds does not lie before all of it.
  template <class Intersect>
  void cast(Packet& packet, const Ray* rays, Hit* hits, std::size_t count, const Intersect& intersect) const {
    LineLanes lines;
    BoundLanes bounds;
    packet.lines(begin, length, lines);
    ground.bounds(lines, bounds);
    RTCRayHit8& found = packet.rays;
    for (std::size_t i = 0; i < kLanes; ++i) found.ray.tfar[i] = static_cast<float>(bounds.leave[i]);
    intersect();
    Lanes<double> wanted;
    double any = 0.0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool before = packet.met(i) && static_cast<double>(found.ray.tfar[i]) <= bounds.enter[i];
      wanted[i] = packet.valid[i] && std::isfinite(bounds.enter[i]) && !before;
      any += wanted[i];
    }
    MeetingLanes meeting;
    if (any > 0.0) ground.meet(lines, wanted, meeting);
    for (std::size_t i = 0; i < count; ++i) {
      const double to_ground = wanted[i] > 0.0 ? meeting.range[i] : static_cast<double>(kEndless);
      if (packet.met(i) && static_cast<double>(found.ray.tfar[i]) <= to_ground)
        hits[i] = partHit(rays[i], found, i);
      else
        hits[i] = std::isfinite(to_ground) ? groundHit(rays[i], meeting, i) : Hit{};
    }
  }

  void castPacket(const Ray* rays, Hit* hits, std::size_t count, bool with_ground) const {
    Packet packet(rays, count, numbered);
    const auto intersect = [&] {
      Context context;
      rtcIntersect8(packet.valid, top.get(), &context, &packet.rays);
    };
    if (with_ground) return cast(packet, rays, hits, count, intersect);
    intersect();
    for (std::size_t i = 0; i < count; ++i)
      hits[i] = packet.met(i) ? partHit(rays[i], packet.rays, i) : Hit{};
  }

  void hidden(const Packet& packet, float distance, bool* results, std::size_t count) const {
    LineLanes lines;
    MeetingLanes meeting;
    Lanes<double> wanted;
    packet.lines(begin, length, lines);
    for (std::size_t i = 0; i < kLanes; ++i) wanted[i] = packet.valid[i] != 0;
    ground.meet(lines, wanted, meeting);
    for (std::size_t i = 0; i < count; ++i)
      results[i] = packet.valid[i] && meeting.range[i] < static_cast<double>(distance);
  }

  void blocked(const Ray* rays, float distance, bool* results, std::size_t count, bool with_ground) const {
    Packet packet(rays, count, numbered);
    std::fill(results, results + count, false);
    if (with_ground) hidden(packet, distance, results, count);
    for (std::size_t i = 0; i < count; ++i) {
      packet.rays.ray.tfar[i] = distance;
      if (results[i] || !(distance > 0.f)) packet.valid[i] = 0;
    }
    Context context;
    rtcOccluded8(packet.valid, top.get(), &context, &packet.rays.ray);
    for (std::size_t i = 0; i < count; ++i)
      if (packet.valid[i]) results[i] = packet.rays.ray.tfar[i] < 0.f;
  }

  /// To what a link's own scene holds, where that is nearer than what `ranges` say.
  void approach(const Instance& instance, const Packet& rays, float* ranges, std::size_t count) const {
    Packet packet = rays;
    RTCRay8& r = packet.rays.ray;
    for (std::size_t i = 0; i < count; ++i) {
      const Affine T = instance.worldToLink(r.time[i]);
      const Eigen::Vector3d origin = T * Eigen::Vector3d(r.org_x[i], r.org_y[i], r.org_z[i]);
      const Eigen::Vector3d along = T.linear() * Eigen::Vector3d(r.dir_x[i], r.dir_y[i], r.dir_z[i]);
      const Eigen::Vector3f o = origin.cast<float>(), d = along.cast<float>();
      r.org_x[i] = o.x(), r.org_y[i] = o.y(), r.org_z[i] = o.z();
      r.dir_x[i] = d.x(), r.dir_y[i] = d.y(), r.dir_z[i] = d.z();
      r.tfar[i] = ranges[i];
    }
    Context context;
    rtcIntersect8(packet.valid, instance.scene, &context, &packet.rays);
    for (std::size_t i = 0; i < count; ++i)
      if (packet.met(i)) ranges[i] = r.tfar[i];
  }
};

Caster::Caster(const World& world) : scene_(std::make_unique<Scene>(world)) { setWindow(0.0, 0.0); }

Caster::~Caster() = default;

void Caster::setWindow(double begin, double end) {
  if (!std::isfinite(begin) || !std::isfinite(end) || end < begin)
    throw std::invalid_argument("a caster's window must be finite and must not end before it begins");
  const bool first = std::isnan(scene_->begin);
  scene_->begin = begin, scene_->length = end - begin;
  if (scene_->instances.setWindow(begin, end) || first) rtcCommitScene(scene_->top.get());
  checkDevice(scene_->device.get(), "building the tree of the world");
}

Hit Caster::cast(const Ray& ray) const {
  Hit hit;
  Packet packet(&ray, 1, scene_->numbered);
  scene_->cast(packet, &ray, &hit, 1, [&] {
    if (!packet.valid[0]) return;
    RTCRayHit query = packet.single(0);
    Context context;
    rtcIntersect1(scene_->top.get(), &context, &query);
    packet.rays.ray.tfar[0] = query.ray.tfar;
    packet.rays.hit.geomID[0] = query.hit.geomID, packet.rays.hit.primID[0] = query.hit.primID;
    packet.rays.hit.instID[0][0] = query.hit.instID[0];
  });
  return hit;
}

void Caster::cast(const Ray* rays, Hit* hits, std::size_t count, bool ground) const {
  for (std::size_t i = 0; i < count; i += kLanes)
    scene_->castPacket(rays + i, hits + i, std::min(kLanes, count - i), ground);
}

bool Caster::blocked(const Ray& ray, float distance) const {
  bool result;
  scene_->blocked(&ray, distance, &result, 1, true);
  return result;
}

void Caster::blocked(const Ray* rays, float distance, bool* results, std::size_t count, bool ground) const {
  for (std::size_t i = 0; i < count; i += kLanes)
    scene_->blocked(rays + i, distance, results + i, std::min(kLanes, count - i), ground);
}

float Caster::rangeTo(int body, const Ray& ray) const {
  float range;
  rangesTo(body, &ray, &range, 1);
  return range;
}

void Caster::rangesTo(int body, const Ray* rays, float* ranges, std::size_t count) const {
  const auto [first, last] = scene_->instances.of(body);
  std::fill(ranges, ranges + count, kEndless);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const std::size_t here = std::min(kLanes, count - i);
    const Packet packet(rays + i, here, scene_->numbered);
    for (unsigned link = first; link < last; ++link)
      scene_->approach(scene_->instances[link], packet, ranges + i, here);
  }
}

}  // namespace field_fusion::core::sim
