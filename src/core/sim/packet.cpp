#include "packet.h"

#include <algorithm>
#include <limits>

#include "cylinder_cast.h"

namespace field_fusion::core::sim {
namespace {

FIELD_FUSION_LANES void check(const RTCRay8& rays, int* valid) {
  constexpr float kMost = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float x = rays.dir_x[i], y = rays.dir_y[i], z = rays.dir_z[i], length = x * x + y * y + z * z;
    const float sum = rays.org_x[i] + rays.org_y[i] + rays.org_z[i] + length, time = rays.time[i];
    valid[i] &= -((std::abs(sum) <= kMost) & (length > 0.f) & (time >= 0.f) & (time <= 1.f));
  }
}

FIELD_FUSION_LANES void number(RTCRay8& rays) {
  const float* const values[] = {rays.org_x, rays.org_y, rays.org_z, rays.dir_x, rays.dir_y, rays.dir_z};
  Lanes<unsigned> h{};
  for (const float* value : values) {
    Lanes<unsigned> bits;
    std::memcpy(bits.of, value, sizeof bits.of);
    for (std::size_t i = 0; i < kLanes; ++i) h[i] = mix(h[i] + bits[i]);
  }
  std::memcpy(rays.id, h.of, sizeof h.of);
}

}  // namespace

Packet::Packet(const Ray* from, std::size_t count, bool numbered) {
  RTCRay8& to = rays.ray;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Ray& ray = from[std::min(i, count - 1)];
    to.org_x[i] = ray.origin.x(), to.org_y[i] = ray.origin.y(), to.org_z[i] = ray.origin.z();
    to.dir_x[i] = ray.direction.x(), to.dir_y[i] = ray.direction.y(), to.dir_z[i] = ray.direction.z();
    to.time[i] = ray.time;
    to.tnear[i] = 0.f, to.tfar[i] = std::numeric_limits<float>::infinity();
    to.mask[i] = 0xffffffff, to.id[i] = to.flags[i] = 0;
    rays.hit.geomID[i] = rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    valid[i] = i < count ? -1 : 0;
  }
  check(to, valid);
  if (numbered) number(to);
}

FIELD_FUSION_LANES void Packet::lines(double begin, double length, LineLanes& out) const {
  const RTCRay8& from = rays.ray;
  for (std::size_t i = 0; i < kLanes; ++i) {
    out.origin[0][i] = from.org_x[i], out.origin[1][i] = from.org_y[i], out.origin[2][i] = from.org_z[i];
    out.direction[0][i] = from.dir_x[i], out.direction[1][i] = from.dir_y[i];
    out.direction[2][i] = from.dir_z[i];
    out.time[i] = begin + length * static_cast<double>(from.time[i]);
  }
}

RTCRayHit Packet::single(std::size_t i) const {
  const RTCRay8& r = rays.ray;
  RTCRayHit out;
  out.ray = {r.org_x[i], r.org_y[i], r.org_z[i], r.tnear[i], r.dir_x[i], r.dir_y[i],
             r.dir_z[i], r.time[i],  r.tfar[i],  r.mask[i],  r.id[i],    r.flags[i]};
  out.hit.geomID = out.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return out;
}

}  // namespace field_fusion::core::sim
