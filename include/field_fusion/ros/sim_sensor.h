#pragma once
// Sensors of a simulated robot as sources of messages.
#include <memory>
#include <string>
#include <vector>

#include "field_fusion/core/sim/caster.h"
#include "field_fusion/core/sim/pose_track.h"
#include "field_fusion/core/sim/sensor_models.h"
#include "field_fusion/ros/sim_output.h"
#include "field_fusion/ros/sim_params.h"

namespace field_fusion {

/// What all sources of a run share.
struct SimSetup {
  const core::sim::World& world;
  core::sim::Caster& caster;
  const SimParams& params;
  std::string sensors;      ///< folder of the sensors' files
  std::string tf_odometry;  ///< the mount that says where the base is on /tf too

  std::uint64_t seedOf(const std::string& what) const;
  const core::sim::SensorKind& kindOf(const core::sim::Mount& mount) const;
};

/// Something that gives out messages at a steady rate.
class SimSource {
 public:
  virtual ~SimSource() = default;
  /// [s] when its next messages are ready.
  double due() const { return static_cast<double>(count_) / rate_ + latency_; }
  void run(const SimSink& sink) {
    measure(static_cast<double>(count_) / rate_, simTime(due()), sink);
    ++count_;
  }

 protected:
  /// `latency` [s] from the stamp of a measurement to its message.
  explicit SimSource(double rate, double latency = 0.0) : rate_(rate), latency_(latency) {}
  virtual void measure(double time, const ros::Time& ready, const SimSink& sink) = 0;

 private:
  double rate_, latency_;
  std::uint64_t count_ = 0;
};

/// A sensor on the robot: names, frame, way, and a clock that may be wrong.
class SimMount {
 public:
  SimMount(const SimSetup& setup, const core::sim::Mount& mount);

  const std::string& name() const { return name_; }
  std::string topic(const char* what) const { return name_ + "/" + what; }
  std::string truthTopic(const char* what) const { return "truth/" + name_ + "/" + what; }
  std_msgs::Header header(double time, const char* frame_suffix = "") const;
  const core::sim::PoseAt& pose() const { return pose_; }  ///< T_world_sensor

 private:
  std::string name_;
  core::sim::PoseAt pose_;
  double clock_error_;
};

using SimSources = std::vector<std::unique_ptr<SimSource>>;

/// What one mount gives. Throws std::runtime_error that names file, line and key of a fault.
std::unique_ptr<SimSource> simSource(const SimSetup& setup, const core::sim::Mount& mount);

// One maker for each of core::sim::SensorParams.
using Mounted = const core::sim::Mount&;
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::Scanner2dParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::Lidar3dParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::DepthCameraParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::CameraParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::ImuParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::GnssParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::WheelOdometryParams&);
std::unique_ptr<SimSource> simSensor(const SimSetup&, Mounted, const core::sim::LegOdometryParams&);

/// What is true of the robot and the bodies, each with its rate.
SimSources simTruth(const SimSetup& setup);

template <class M>
void send(const SimSink& sink, std::string topic, const ros::Time& ready, boost::shared_ptr<M> message) {
  sink({std::move(topic), ready, boost::shared_ptr<const M>(std::move(message)), false});
}

}  // namespace field_fusion
