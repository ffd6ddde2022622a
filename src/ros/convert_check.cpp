// What a message of ours must be before core may work on it.
#include <stdexcept>
#include <string>

#include "field_fusion/ros/convert.h"

namespace field_fusion {
namespace {

template <class Xyz>
bool finite(const Xyz& p) {
  return std::isfinite(p.x + p.y + p.z);
}

/// An oriented box is known altogether or not at all.
bool soundBox(const Cluster& c) {
  const auto& size = c.box_size;
  const bool unknown = std::isnan(c.box_yaw) && std::isnan(c.box_centre.x) && std::isnan(c.box_centre.y) &&
                       std::isnan(c.box_centre.z) && std::isnan(size.x) && std::isnan(size.y) &&
                       std::isnan(size.z);
  const bool known = std::isfinite(c.box_yaw) && finite(c.box_centre) && finite(size);
  return unknown || (known && size.x >= size.y && size.y >= 0.0 && size.z >= 0.0);
}

/// What is wrong with the cluster that stands at place `place`; null when nothing is.
const char* faultOf(const Cluster& c, std::size_t place, std::size_t point_count) {
  if (c.id != place) return "has an id that is not its place";
  if (!finite(c.min) || !finite(c.max) || !finite(c.centre) ||
      !std::isfinite(c.range + c.azimuth + c.elevation))
    return "is not finite";
  if (c.min.x > c.max.x || c.min.y > c.max.y || c.min.z > c.max.z) return "has a box with min above max";
  if (!soundBox(c)) return "has an oriented box that is half known, inside out or wider than long";
  if (std::uint64_t{c.first_point} + c.point_count > point_count) return "names points that are not there";
  return nullptr;
}

bool infiniteOrNegative(float x) { return std::isinf(x) || x < 0.f; }

const char* faultOf(const ImageDetection& d, std::size_t place) {
  if (d.id != place) return "has an id that is not its place";
  if (!(d.score >= 0.f && d.score <= 1.f)) return "has a score outside 0..1";
  if (infiniteOrNegative(d.range) || infiniteOrNegative(d.range_sigma))
    return "has a negative or infinite range";
  const double norm2 = d.ray.x * d.ray.x + d.ray.y * d.ray.y + d.ray.z * d.ray.z;
  if (std::abs(norm2 - 1.0) > 1e-3) return "has a ray that is no unit vector";  // NaN passes: unknown
  return nullptr;
}

}  // namespace

void check(const ClusterArray& message) {
  for (std::size_t i = 0; i < message.clusters.size(); ++i)
    if (const char* fault = faultOf(message.clusters[i], i, message.points.size()))
      throw std::runtime_error("clusters damaged: number " + std::to_string(i) + " " + fault);
}

void check(const ImageDetectionArray& message) {
  for (std::size_t i = 0; i < message.detections.size(); ++i)
    if (const char* fault = faultOf(message.detections[i], i))
      throw std::runtime_error("detections damaged: number " + std::to_string(i) + " " + fault);
}

}  // namespace field_fusion
