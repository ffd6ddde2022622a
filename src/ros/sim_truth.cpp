// What is true: the robot's way, the bodies, the map. No stage may read it.
#include <tf2_eigen/tf2_eigen.h>
#include <boost/make_shared.hpp>

#include "field_fusion/core/sim/truth.h"
#include "field_fusion/ros/grid_message.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_markers.h"
#include "field_fusion/ros/sim_sensor.h"

namespace field_fusion {
namespace {

namespace sim = core::sim;

constexpr double kPoseRate = 50.0, kBodyRate = 10.0;  // Hz
constexpr double kMarkRate = 0.5;                     // Hz
constexpr double kDifference = 1e-3;                  // s, for velocities

std_msgs::Header worldHeader(double time) {
  std_msgs::Header header;
  header.stamp = simTime(time);
  header.frame_id = "world";
  return header;
}

class PoseSource : public SimSource {
 public:
  explicit PoseSource(const SimSetup& setup) : SimSource(kPoseRate), way_(setup.world.robot.way) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const core::Transform T_world_base = way_.pose(time);
    auto pose = boost::make_shared<nav_msgs::Odometry>();
    pose->header = worldHeader(time);
    pose->child_frame_id = "base";
    pose->pose.pose = tf2::toMsg(T_world_base);
    tf2::toMsg(way_.velocity(time), pose->twist.twist.linear);
    tf2::toMsg(way_.angularVelocity(time), pose->twist.twist.angular);
    send(sink, "truth/pose", ready, pose);
    auto tf = boost::make_shared<tf2_msgs::TFMessage>();
    tf->transforms.push_back(transformMessage(pose->header.stamp, "world", "base", T_world_base));
    send(sink, "truth/tf", ready, tf);
  }

  sim::Trajectory way_;
};

class BodySource : public SimSource {
 public:
  explicit BodySource(const SimSetup& setup) : SimSource(kBodyRate), world_(setup.world) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    auto bodies = boost::make_shared<TruthBodies>();
    bodies->header = worldHeader(time);
    for (const sim::TruthBox& box : sim::truthAt(world_, time)) {
      TruthBody body;
      body.id = static_cast<std::uint32_t>(bodies->bodies.size());
      body.name = box.name;
      body.label = box.label;
      body.pose = tf2::toMsg(box.T_world_box);
      tf2::toMsg(box.size, body.size);
      tf2::toMsg(velocity(world_.bodies[body.id].way, time), body.velocity);
      bodies->bodies.push_back(std::move(body));
    }
    const auto frames = linkFrames(world_, time);
    send(sink, "truth/bodies", ready, bodies);
    if (frames.empty()) return;
    auto tf = boost::make_shared<tf2_msgs::TFMessage>();
    tf->transforms = frames;
    send(sink, "truth/tf", ready, tf);
  }

  static Eigen::Vector3d velocity(const sim::Trajectory& way, double time) {
    if (way.still()) return Eigen::Vector3d::Zero();
    return (way.pose(time + kDifference).translation() - way.pose(time - kDifference).translation()) /
           (2.0 * kDifference);
  }

  const sim::World& world_;
};

class MarkSource : public SimSource {
 public:
  explicit MarkSource(boost::shared_ptr<const visualization_msgs::MarkerArray> marks)
      : SimSource(kMarkRate), marks_(std::move(marks)) {}

 private:
  void measure(double, const ros::Time& ready, const SimSink& sink) override {
    send(sink, "truth/moving_markers", ready, marks_);
  }

  boost::shared_ptr<const visualization_msgs::MarkerArray> marks_;
};

}  // namespace

boost::shared_ptr<const nav_msgs::OccupancyGrid> truthGrid(const sim::World& world, double height) {
  sim::SliceParams slice;
  slice.low = slice.high = height;
  const sim::TruthGrid truth = sim::occupancy(world, 0.0, slice);
  core::Occupancy map{truth.cell, truth.origin.x(), truth.origin.y(), truth.columns, truth.rows, {}};
  for (const std::uint8_t cell : truth.occupied) map.cells.push_back(cell ? core::kWallCell : core::kFreeCell);
  return gridMessage(worldHeader(0.0), map);
}

SimSources simTruth(const SimSetup& setup) {
  SimSources out;
  out.push_back(std::make_unique<PoseSource>(setup));
  if (!setup.world.bodies.empty()) out.push_back(std::make_unique<BodySource>(setup));
  const auto moving = worldMarkers(setup.world, Marks::kMoving);
  if (!moving->markers.empty()) out.push_back(std::make_unique<MarkSource>(moving));
  return out;
}

}  // namespace field_fusion
