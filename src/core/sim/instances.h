#pragma once
// The links of a world where Embree sees them, those that move at several instants of the window.
#include <Eigen/StdVector>

#include "embree.h"
#include "field_fusion/core/sim/caster.h"
#include "ray_cut.h"

namespace field_fusion::core::sim {

using Affine = Eigen::AffineCompact3d;

struct Instance {
  const Link* link;
  int body;                          ///< place in World::bodies, or Hit::kRobot
  std::size_t place;                 ///< of the link in its model
  RTCScene scene;                    ///< of the link alone
  RTCGeometry geometry;              ///< the scene owns it
  Affine T_link_world;               ///< of one that stands still or is frozen
  std::vector<Affine> T_world_link;  ///< at even instants of the window; empty: stands still

  bool frozen = false;               ///< the window is an instant, as for a camera's global shutter

  /// As Embree sees it: between two instants the matrix is a straight mixture. `time` is 0..1.
  Affine worldToLink(float time) const;
};

class Instances {
 public:
  Instances(const World& world, RTCDevice device, RTCScene scene);

  /// Moves what moves. Returns whether anything did.
  bool setWindow(double begin, double end);
  const Instance& operator[](unsigned i) const { return list_[i]; }
  std::size_t size() const { return list_.size(); }
  /// Of one body: they follow each other, from the one to before the other.
  std::pair<unsigned, unsigned> of(int body) const;

 private:
  void add(const Model& model, const Trajectory& way, int body);

  const World& world_;
  RTCDevice device_;
  RTCScene scene_;
  LinkScenes scenes_;
  std::vector<Instance> list_;
};

}  // namespace field_fusion::core::sim
