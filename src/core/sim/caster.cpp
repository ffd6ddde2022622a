#include "field_fusion/core/sim/caster.h"

#include <cmath>
#include <stdexcept>

#include "ground_cast.h"
#include "instances.h"

namespace field_fusion::core::sim {
namespace {

constexpr std::size_t kPacket = 8;
constexpr float kEndless = std::numeric_limits<float>::infinity();

Line lineOf(const Ray& ray) { return {ray.origin.cast<double>(), ray.direction.cast<double>()}; }

/// Embree may do anything with rays that are not.
bool castable(const Ray& ray) {
  const float length = ray.direction.squaredNorm();
  return std::isfinite(ray.origin.sum() + length) && length > 0.f && ray.time >= 0.f && ray.time <= 1.f;
}

RTCRay embreeRay(const Ray& ray, float reach, bool numbered) {
  const unsigned number = numbered ? rayNumber(ray.origin, ray.direction) : 0;
  return {ray.origin.x(),
          ray.origin.y(),
          ray.origin.z(),
          0.f,
          ray.direction.x(),
          ray.direction.y(),
          ray.direction.z(),
          ray.time,
          reach,
          0xffffffff,
          number,
          0};
}

void put(const RTCRay& ray, RTCRayHit8& packet, std::size_t i) {
  RTCRay8& to = packet.ray;
  to.org_x[i] = ray.org_x, to.org_y[i] = ray.org_y, to.org_z[i] = ray.org_z, to.tnear[i] = ray.tnear;
  to.dir_x[i] = ray.dir_x, to.dir_y[i] = ray.dir_y, to.dir_z[i] = ray.dir_z, to.time[i] = ray.time;
  to.tfar[i] = ray.tfar, to.mask[i] = ray.mask, to.id[i] = ray.id, to.flags[i] = ray.flags;
  packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
}

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

/// What Embree found of one ray.
struct Found {
  float range;
  unsigned instance, geometry, primitive;
};

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

  double groundRange(const Ray& ray) const { return ground.range(lineOf(ray), begin + length * ray.time); }

  Hit groundHit(const Ray& ray, double range) const {
    const Line line = lineOf(ray);
    const Eigen::Vector3d at = line.at(range), up = ground.normal(at, begin + length * ray.time);
    const Eigen::Vector3d towards = up.dot(line.direction) > 0.0 ? -up : up;
    return {static_cast<float>(range), Hit::kGround, towards.cast<float>(), at.cast<float>(),
            &world.ground.material};
  }

  Hit partHit(const Ray& ray, const Found& found) const {
    const bool instanced = found.instance != RTC_INVALID_GEOMETRY_ID;
    const Instance* instance = instanced ? &instances[found.instance] : nullptr;
    const Part& part = instanced ? instance->link->parts[found.geometry] : rough;
    const Affine T = instanced ? instance->worldToLink(ray.time) : Affine::Identity();
    const Line world_line = lineOf(ray), line{T * world_line.origin, T.linear() * world_line.direction};
    const Cut c = cut(line, part.shape, found.primitive, static_cast<double>(found.range));
    const Eigen::Vector3d out = (T.linear().transpose() * c.normal).normalized();
    const Eigen::Vector3d towards = out.dot(world_line.direction) > 0.0 ? -out : out;
    return {static_cast<float>(c.t), instanced ? instance->body : Hit::kGround, towards.cast<float>(),
            line.at(c.t).cast<float>(), instanced ? &part.material : &world.ground.material};
  }

  /// The water is looked for only where Embree's find does not lie before all of it.
  Hit finish(const Ray& ray, const Span& ground_bounds, const Found& found) const {
    const bool met = found.geometry != RTC_INVALID_GEOMETRY_ID;
    if (met && static_cast<double>(found.range) <= ground_bounds.enter) return partHit(ray, found);
    const double to_ground = std::isfinite(ground_bounds.enter) ? groundRange(ray) : kEndless;
    if (met && static_cast<double>(found.range) <= to_ground) return partHit(ray, found);
    return std::isfinite(to_ground) ? groundHit(ray, to_ground) : Hit{};
  }

  void castPacket(const Ray* rays, Hit* hits, std::size_t count, bool with_ground) const {
    alignas(32) int valid[kPacket] = {};
    Span bounds[kPacket];
    RTCRayHit8 packet;
    for (std::size_t i = 0; i < kPacket; ++i) {
      if (i >= count || !castable(rays[i])) continue;
      bounds[i] = with_ground ? ground.bounds(lineOf(rays[i])) : Span{kEndless, kEndless};
      put(embreeRay(rays[i], static_cast<float>(bounds[i].leave), numbered), packet, i);
      valid[i] = -1;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, top.get(), &context, &packet);
    for (std::size_t i = 0; i < count; ++i)
      hits[i] = valid[i] ? finish(rays[i], bounds[i],
                                  {packet.ray.tfar[i], packet.hit.instID[0][i], packet.hit.geomID[i],
                                   packet.hit.primID[i]})
                         : Hit{};
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
  if (!castable(ray)) return {};
  const Span bounds = scene_->ground.bounds(lineOf(ray));
  RTCRayHit query{embreeRay(ray, static_cast<float>(bounds.leave), scene_->numbered), {}};
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->top.get(), &context, &query);
  return scene_->finish(ray, bounds,
                        {query.ray.tfar, query.hit.instID[0], query.hit.geomID, query.hit.primID});
}

void Caster::cast(const Ray* rays, Hit* hits, std::size_t count, bool ground) const {
  for (std::size_t i = 0; i < count; i += kPacket)
    scene_->castPacket(rays + i, hits + i, std::min(kPacket, count - i), ground);
}

bool Caster::blocked(const Ray& ray, float distance) const {
  if (!castable(ray) || !(distance > 0.f)) return false;
  if (scene_->groundRange(ray) < static_cast<double>(distance)) return true;
  RTCRay query = embreeRay(ray, distance, scene_->numbered);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->top.get(), &context, &query);
  return query.tfar < 0.f;
}

void Caster::blocked(const Ray* rays, float distance, bool* results, std::size_t count, bool ground) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t from = 0; from < count; from += kPacket) {
    const std::size_t here = std::min(kPacket, count - from);
    alignas(32) int valid[kPacket] = {};
    RTCRayHit8 packet;
    for (std::size_t i = 0; i < here; ++i) {
      const Ray& ray = rays[from + i];
      results[from + i] = false;
      if (!castable(ray) || !(distance > 0.f)) continue;
      results[from + i] = ground && scene_->groundRange(ray) < static_cast<double>(distance);
      put(embreeRay(ray, distance, scene_->numbered), packet, i);
      valid[i] = results[from + i] ? 0 : -1;
    }
    rtcOccluded8(valid, scene_->top.get(), &context, &packet.ray);
    for (std::size_t i = 0; i < here; ++i)
      if (valid[i]) results[from + i] = packet.ray.tfar[i] < 0.f;
  }
}

float Caster::rangeTo(int body, const Ray& ray) const {
  if (!castable(ray)) return kEndless;
  const auto [first, last] = scene_->instances.of(body);
  float nearest = kEndless;
  for (unsigned i = first; i < last; ++i) {
    const Instance& instance = scene_->instances[i];
    const Affine T = instance.worldToLink(ray.time);
    RTCRayHit query{embreeRay(ray, nearest, scene_->numbered), {}};
    const Eigen::Vector3f origin = (T * ray.origin.cast<double>()).cast<float>();
    const Eigen::Vector3f direction = (T.linear() * ray.direction.cast<double>()).cast<float>();
    query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
    query.ray.dir_x = direction.x(), query.ray.dir_y = direction.y(), query.ray.dir_z = direction.z();
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(instance.scene, &context, &query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) nearest = query.ray.tfar;
  }
  return nearest;
}

}  // namespace field_fusion::core::sim
