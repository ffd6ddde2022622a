// What a message of ours must be before core may work on it.
#include <boost/make_shared.hpp>

#include <stdexcept>
#include <string>

#include "field_fusion/ros/convert.h"

namespace field_fusion {
namespace {

/// So far away no body is seen; also what keeps a coordinate from overflowing as a float.
constexpr double kFar = 1e9;  // m

template <class Xyz>
bool finite(const Xyz& p) {
  return std::abs(p.x) < kFar && std::abs(p.y) < kFar && std::abs(p.z) < kFar;  // NaN fails
}

template <class Xyz>
bool unknown(const Xyz& p) {
  return std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z);
}

bool isRange(double x) { return x >= 0.0 && x < kFar; }
bool isAngle(double x) { return std::abs(x) <= core::radians(360.0); }

/// An oriented box is known altogether or not at all.
bool soundBox(const Cluster& c) {
  const auto& size = c.box_size;
  const bool none = std::isnan(c.box_yaw) && unknown(c.box_centre) && unknown(size);
  const bool whole = isAngle(c.box_yaw) && finite(c.box_centre) && finite(size);
  return none || (whole && size.x >= size.y && size.y >= 0.0 && size.z >= 0.0);
}

/// What is wrong with the cluster that stands at place `place`; null when nothing is.
const char* faultOf(const Cluster& c, std::size_t place, std::size_t point_count) {
  if (c.id != place) return "has an id that is not its place";
  if (!finite(c.min) || !finite(c.max) || !finite(c.centre)) return "is not finite";
  if (!isRange(c.range) || !isRange(c.nearest_range) || !isAngle(c.azimuth) || !isAngle(c.elevation))
    return "has a range or angle that is impossible";
  if (c.min.x > c.max.x || c.min.y > c.max.y || c.min.z > c.max.z) return "has a box with min above max";
  if (!soundBox(c)) return "has an oriented box that is half known, inside out or wider than long";
  if (std::uint64_t{c.first_point} + c.point_count > point_count) return "names points that are not there";
  return nullptr;
}

/// NaN passes: unknown.
template <class Xyz>
bool notUnit(const Xyz& p) {
  return std::abs(p.x * p.x + p.y * p.y + p.z * p.z - 1.0) > 1e-3;
}

/// False for NaN. The size of the image may be unknown (0).
bool isBox(const ImageDetection& d, const ImageDetectionArray& image) {
  const auto within = [](float low, float high, std::uint32_t size) {
    return low <= high && std::isfinite(high - low) &&
           (size == 0 || (high >= 0.f && low <= static_cast<float>(size)));
  };
  return within(d.x_min, d.x_max, image.width) && within(d.y_min, d.y_max, image.height);
}

bool infiniteOrNegative(float x) { return std::isinf(x) || x < 0.f; }

const char* faultOf(const ImageDetection& d, std::size_t place, const ImageDetectionArray& image) {
  if (d.id != place) return "has an id that is not its place";
  if (!isBox(d, image)) return "has a box that is inside out, not finite or outside the image";
  if (!(d.score >= 0.f && d.score <= 1.f)) return "has a score outside 0..1";
  if (infiniteOrNegative(d.range) || infiniteOrNegative(d.range_sigma))
    return "has a negative or infinite range";
  if (notUnit(d.ray) || notUnit(d.ray_min) || notUnit(d.ray_max)) return "has a ray that is no unit vector";
  return nullptr;
}

const char* faultOf(const Obstacle& o) {
  if (!finite(o.position) && !unknown(o.position)) return "has a position that is neither finite nor unknown";
  const bool size_known = finite(o.size) && o.size.x >= 0.0 && o.size.y >= 0.0 && o.size.z >= 0.0;
  if (!size_known && !unknown(o.size)) return "has a size that is neither possible nor unknown";
  if (!finite(o.face) && !unknown(o.face)) return "has a face that is neither finite nor unknown";
  const auto known = [](double x) { return !std::isnan(x); };
  if ((known(o.range) && !isRange(o.range)) || (known(o.azimuth) && !isAngle(o.azimuth)) ||
      (known(o.elevation) && !isAngle(o.elevation)))
    return "has a range or angle that is impossible";
  if (std::isinf(o.range_difference) || std::isinf(o.azimuth_difference) || std::isinf(o.distance))
    return "has an infinite difference";
  return nullptr;
}

}  // namespace

void check(const ObstacleArray& message) {
  for (std::size_t i = 0; i < message.obstacles.size(); ++i)
    if (const char* fault = faultOf(message.obstacles[i]))
      throw std::runtime_error("obstacles damaged: number " + std::to_string(i) + " " + fault);
}

void check(const ClusterArray& message) {
  for (std::size_t i = 0; i < message.clusters.size(); ++i)
    if (const char* fault = faultOf(message.clusters[i], i, message.points.size()))
      throw std::runtime_error("clusters damaged: number " + std::to_string(i) + " " + fault);
}

ImageDetectionArray::ConstPtr soundDetections(const ImageDetectionArray::ConstPtr& message,
                                              std::string& damage) {
  damage.clear();
  ImageDetectionArray::Ptr sound;
  const auto& all = message->detections;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const char* fault = faultOf(all[i], i, *message);
    if (fault && !sound) {
      damage = "detections damaged: number " + std::to_string(i) + " " + fault;
      sound = boost::make_shared<ImageDetectionArray>(*message);
      sound->detections.resize(i);
    } else if (!fault && sound) {
      sound->detections.push_back(all[i]);
    }
  }
  return sound ? sound : message;
}

}  // namespace field_fusion
