#pragma once
// A stand-in harbour for measuring: cages, boats, buoys, a quay with people, cars and trees, and waves.
#include "field_fusion/core/sim/ride.h"
#include "field_fusion/core/sim/shapes.h"
#include "field_fusion/core/sim/world.h"

namespace field_fusion::bench {

class Harbour {
 public:
  static core::sim::World world() {
    Harbour h;
    core::sim::Ground& water = h.world_.ground;
    water.kind = core::sim::Ground::Kind::kWater;
    water.waves = {{0.12, 9.0, 0.4, 0.0}, {0.07, 5.0, -0.3, 1.0}, {0.04, 2.9, 0.9, 2.0}};
    water.material.colour = {0.012f, 0.05f, 0.06f};
    h.world_.light.to_sun = Eigen::Vector3d(-0.35, 0.6, 0.7).normalized();
    h.afloat();
    h.ashore();
    return h.world_;
  }

 private:
  void add(const char* shape, const char* label, double x, double y, double yaw_deg, double z = 0.0,
           bool floats = false, const core::sim::ShapeParams& params = {}) {
    core::sim::Body body;
    body.name = shape + std::to_string(world_.bodies.size());
    body.label = label;
    body.model = core::sim::makeShape(shape, params);
    body.way = core::sim::Trajectory({{{x, y, z}, core::radians(yaw_deg), 0.0}}, {});
    if (floats)
      body.way = core::sim::carriedByGround(body.way, world_.ground, core::sim::Ride::kFloating, 4.0, 2.0);
    world_.bodies.push_back(body);
  }
  void afloat() {
    add("cage", "cage", 16, 6, 0, 0, true);
    add("cage", "cage", 30, -9, 0, 0, true);
    add("boat", "boat", 13, -4, 60, 0, true);
    add("boat", "boat", 26, 3, -30, 0, true);
    add("boat", "boat", 60, -20, 100, 0, true);
    for (int i = 0; i < 4; ++i) add("buoy", "buoy", 9.0 + 7 * i, 2.5 - 4 * (i % 3), 0, 0, true);
  }
  void ashore() {
    add("quay", "", 50, 14, 0, 0, false, {{"length", 60}, {"width", 8}, {"height", 1.6}});
    for (int i = 0; i < 5; ++i) add("person", "person", 34.0 + 2.6 * i, 11.5 + 0.7 * i, 80.0 * i, 1.6);
    for (int i = 0; i < 3; ++i) add("car", "car", 38.0 + 8 * i, 15.5, 5.0 * i, 1.6);
    for (int i = 0; i < 4; ++i) add("tree", "", 36.0 + 7 * i, 17.3, 0, 1.6);
    for (int i = 0; i < 4; ++i) add("bollard", "", 33.0 + 7 * i, 10.5, 0, 1.6);
    add("container", "", 62, 15, 90, 1.6);
  }

  core::sim::World world_;
};

}  // namespace field_fusion::bench
