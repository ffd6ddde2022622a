#pragma once
// Owners of Embree's handles, and the scene of one link, which all links of equal parts share.
#include <embree3/rtcore.h>

#include <memory>
#include <vector>

#include "field_fusion/core/sim/model.h"

namespace field_fusion::core::sim {

template <class Handle, void (*release)(Handle)>
struct Releaser {
  using pointer = Handle;
  void operator()(Handle handle) const { release(handle); }
};
using Device = std::unique_ptr<RTCDevice, Releaser<RTCDevice, rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<RTCScene, Releaser<RTCScene, rtcReleaseScene>>;
using Geometry = std::unique_ptr<RTCGeometry, Releaser<RTCGeometry, rtcReleaseGeometry>>;

/// Throws std::runtime_error where Embree does not run.
Device newDevice();
/// Throws std::runtime_error with Embree's own words when the last calls failed.
void checkDevice(RTCDevice device, const char* doing);

/// Attaches the shape under the number `id`. Rays pass it by chance as its transparency says; see
/// Packet. The shape must outlive the scene.
void attach(RTCDevice device, RTCScene scene, unsigned id, const Part& part);

/// Throws std::invalid_argument for sizes that are not above 0 or not finite, and for meshes that are empty
/// or name vertices that are not there.
void checkShape(const Shape& shape);

/// Scenes of links, one for all that equal each other.
class LinkScenes {
 public:
  explicit LinkScenes(RTCDevice device) : device_(device) {}

  RTCScene of(const Link& link);

 private:
  struct Known {
    const Link* link;
    SceneHandle scene;
  };
  RTCDevice device_;
  std::vector<Known> known_;
};

}  // namespace field_fusion::core::sim
