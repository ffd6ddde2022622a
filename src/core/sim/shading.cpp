#include "shading.h"

#include <algorithm>
#include <cmath>

#include "texture.h"

namespace field_fusion::core::sim {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr float kMirrorReach = 200.f;  // [m] farther off water mirrors the sky alone
constexpr float kFaint = 1e-5f;        // glitter that no sensor sees
constexpr float kGlossPower = 80.f;    // of the highlight's lobe (Blinn 1977)

/// A little off the surface, so that a ray does not meet it again.
Ray leaving(const Ray& ray, const Hit& hit, const Eigen::Vector3f& direction) {
  const float off = 5e-4f + 1e-4f * hit.range;
  return {ray.origin + hit.range * ray.direction + off * hit.normal, direction, ray.time};
}

}  // namespace

Shader::Shader(const World& world, float pixel_angle, bool reflections)
    : sky_(world.light),
      ripples_(sky_.toSun()),
      water_(world.ground.kind == Ground::Kind::kWater),
      reflections_(reflections && water_),
      pixel_angle_(pixel_angle),
      visibility_(static_cast<float>(world.light.visibility)) {
  const float sun_height = std::max(0.f, sky_.toSun().z());
  const Eigen::Vector3f light =
      sun_height * sky_.sun() + sky_.ambient(Eigen::Vector3f::UnitZ(), Eigen::Vector3f::Zero());
  bounce_ = world.ground.kind == Ground::Kind::kNone ? Eigen::Vector3f(0.2f * light)
                                                     : world.ground.material.colour.cwiseProduct(light);
  below_ = world.ground.material.colour.cwiseProduct(light);  // a shadow on deep water is hardly seen
}

float Shader::footprint(const Ray& ray, const Hit& hit) const {
  const float slant = std::max(0.02f, std::abs(hit.normal.dot(ray.direction)));
  return pixel_angle_ * hit.range / std::sqrt(slant);
}

Eigen::Vector3f Shader::hazed(const Eigen::Vector3f& colour, float range) const {
  return colour + (1.f - std::exp(-range / visibility_)) * (sky_.haze() - colour);
}

Eigen::Vector3f Shader::surface(const Ray& ray, const Hit& hit, bool lit) const {
  const Material& material = *hit.material;
  const Eigen::Vector3f& n = hit.normal;
  const float size = footprint(ray, hit);
  Eigen::Vector3f albedo = colourAt(material, hit.place, size);
  if (hit.body == Hit::kGround) albedo *= groundMottle(hit.place, size);
  const float gloss = std::clamp(material.gloss, 0.f, 1.f), towards = n.dot(sky_.toSun());
  Eigen::Vector3f light = sky_.ambient(n, bounce_);
  if (lit) light += towards * sky_.sun();
  Eigen::Vector3f out = (1.f - gloss) * albedo.cwiseProduct(light);
  if (gloss == 0.f) return hazed(out, hit.range);
  const Eigen::Vector3f mirrored = ray.direction - 2.f * ray.direction.dot(n) * n;
  const float grazing = std::pow(1.f - std::clamp(-ray.direction.dot(n), 0.f, 1.f), 5.f);
  const Eigen::Vector3f seen = mirrored.z() > 0.f ? sky_.radiance(mirrored) : bounce_;
  out += gloss * (0.15f + 0.85f * grazing) * seen;
  if (lit) {
    const float half = std::max(0.f, n.dot((sky_.toSun() - ray.direction).normalized()));
    out += gloss * towards * (kGlossPower + 2.f) / 8.f * 0.15f * std::pow(half, kGlossPower) * sky_.sun();
  }
  return hazed(out, hit.range);
}

Eigen::Vector3f Shader::waterSurface(const Hit& hit, bool lit, const WaterLook& look,
                                     const Eigen::Vector3f& mirrored) const {
  Eigen::Vector3f out = below_ + look.share * (mirrored - below_);
  if (lit) out += look.glitter * sky_.sun();
  return hazed(out, hit.range);
}

void Shader::castShadows(const Caster& caster, const Ray* rays, const Hit* hits, std::size_t count,
                         Scratch& s) const {
  s.lit.assign(count, 0), s.rays.clear(), s.pixels.clear();
  if (!(sky_.sun().sum() > 0.f)) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (hits[i].body == Hit::kNothing) continue;
    const bool faces =
        isWater(hits[i]) ? s.looks[i].glitter > kFaint : hits[i].normal.dot(sky_.toSun()) > 0.f;
    if (!faces) continue;
    s.rays.push_back(leaving(rays[i], hits[i], sky_.toSun())), s.pixels.push_back(i);
  }
  if (s.blocked_size < count) s.blocked = std::make_unique<bool[]>(s.blocked_size = count);
  // the sun is above any ground without hills, those of a rough one are a mesh
  const bool ground = sky_.toSun().z() <= 0.f;
  caster.blocked(s.rays.data(), kEndless, s.blocked.get(), s.rays.size(), ground);
  for (std::size_t j = 0; j < s.pixels.size(); ++j) s.lit[s.pixels[j]] = !s.blocked[j];
}

void Shader::lookAtWater(const Ray* rays, const Hit* hits, double time, Scratch& s) const {
  WaterPlaces places;
  WaterLook looks[kLanes];
  for (std::size_t from = 0; from < s.water.size(); from += kLanes) {
    const std::size_t here = std::min(kLanes, s.water.size() - from);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = s.water[from + std::min(lane, here - 1)];
      places.x[lane] = hits[i].place.x(), places.y[lane] = hits[i].place.y();
      for (int axis = 0; axis < 3; ++axis) {
        places.normal[axis][lane] = hits[i].normal[axis];
        places.sight[axis][lane] = rays[i].direction[axis];
      }
      places.footprint[lane] = footprint(rays[i], hits[i]);
    }
    ripples_.look(places, time, looks, here);
    for (std::size_t lane = 0; lane < here; ++lane) s.looks[s.water[from + lane]] = looks[lane];
  }
}

void Shader::castMirrored(const Caster& caster, const Ray* rays, const Hit* hits, std::size_t count,
                          double time, Scratch& s) const {
  s.looks.resize(count), s.mirrored.resize(count), s.rays.clear(), s.pixels.clear(), s.water.clear();
  for (std::size_t i = 0; i < count; ++i)
    if (isWater(hits[i])) s.water.push_back(i);
  lookAtWater(rays, hits, time, s);
  for (const std::size_t i : s.water) {
    const Eigen::Vector3f& towards = s.looks[i].mirrored;
    s.mirrored[i] = sky_.radiance(towards);
    if (!reflections_ || hits[i].range > kMirrorReach) continue;
    s.rays.push_back(leaving(rays[i], hits[i], towards)), s.pixels.push_back(i);
  }
  s.hits.resize(s.rays.size());
  caster.cast(s.rays.data(), s.hits.data(), s.rays.size(), false);
  for (std::size_t j = 0; j < s.rays.size(); ++j) {
    const Hit& hit = s.hits[j];
    if (hit.body == Hit::kNothing || isWater(hit)) continue;
    s.mirrored[s.pixels[j]] = surface(s.rays[j], hit, hit.normal.dot(sky_.toSun()) > 0.f);
  }
}

void Shader::shade(const Caster& caster, const Ray* rays, const Hit* hits, std::size_t count, double time,
                   Scratch& s, Eigen::Vector3f* out) const {
  if (water_) castMirrored(caster, rays, hits, count, time, s);
  castShadows(caster, rays, hits, count, s);
  for (std::size_t i = 0; i < count; ++i) {
    const Hit& hit = hits[i];
    if (hit.body == Hit::kNothing)
      out[i] = rays[i].direction.z() < 0.f ? sky_.haze() : sky_.withSun(rays[i].direction);
    else if (isWater(hit))
      out[i] = waterSurface(hit, s.lit[i], s.looks[i], s.mirrored[i]);
    else
      out[i] = surface(rays[i], hit, s.lit[i]);
  }
}

}  // namespace field_fusion::core::sim
