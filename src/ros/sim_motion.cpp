// Inertial unit, satellite receiver and odometry of the simulator.
#include <tf2_eigen/tf2_eigen.h>
#include <boost/make_shared.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "field_fusion/core/sim/gnss.h"
#include "field_fusion/core/sim/imu.h"
#include "field_fusion/core/sim/odometry.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/sim_sensor.h"

namespace field_fusion {
namespace {

namespace sim = core::sim;

constexpr double kEarthRadius = 6378137.0;                // m, WGS 84
constexpr double kLatitude = 25.15, kLongitude = 121.78;  // deg of the world's origin, near Keelung
constexpr double kUnknown = 1e6;                          // variance of what an odometry does not measure
constexpr double kLeast = 1e-9;                           // variance of what has no error: a filter cannot take 0

/// NaN: not measured.
double variance(double sigma) { return std::isnan(sigma) ? kUnknown : std::max(sigma * sigma, kLeast); }

void set(geometry_msgs::Vector3& out, const Eigen::Vector3d& v) { tf2::toMsg(v, out); }

class ImuSource : public SimSource {
 public:
  ImuSource(const SimSetup& setup, const sim::Mount& mount, const sim::ImuParams& params)
      : SimSource(params.rate),
        mount_(setup, mount),
        imu_(params, setup.world.robot.way, mount.T_base_sensor, setup.seedOf(mount.name)) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const sim::ImuSample sample = imu_.next();
    auto message = boost::make_shared<sensor_msgs::Imu>();
    message->header = mount_.header(time);
    message->orientation.w = 1.0;
    message->orientation_covariance[0] = -1.0;  // by sensor_msgs/Imu: not measured
    set(message->angular_velocity, sample.angular_rate);
    set(message->linear_acceleration, sample.specific_force);
    for (const std::size_t axis : {0, 1, 2}) {
      message->angular_velocity_covariance[4 * axis] = variance(sample.sigma_rate);
      message->linear_acceleration_covariance[4 * axis] = variance(sample.sigma_force);
    }
    send(sink, mount_.topic("data"), ready, message);
  }

  SimMount mount_;
  sim::Imu imu_;
};

class GnssSource : public SimSource {
 public:
  GnssSource(const SimSetup& setup, const sim::Mount& mount, const sim::GnssParams& params)
      : SimSource(params.rate),
        mount_(setup, mount),
        gnss_(params, setup.world.robot.way, mount.T_base_sensor, setup.seedOf(mount.name)) {}

 private:
  /// On a sphere: right to a part in a million over the extent of a world.
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const sim::GnssSample sample = gnss_.next();
    auto message = boost::make_shared<sensor_msgs::NavSatFix>();
    message->header = mount_.header(time);
    message->status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
    message->status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
    message->latitude = kLatitude + core::degrees(sample.position.y() / kEarthRadius);
    message->longitude =
        kLongitude + core::degrees(sample.position.x() / (kEarthRadius * std::cos(core::radians(kLatitude))));
    message->altitude = sample.position.z();
    for (std::size_t i = 0; i < 3; ++i)
      message->position_covariance[4 * i] = std::pow(sample.sigma[static_cast<Eigen::Index>(i)], 2);
    message->position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
    send(sink, mount_.topic("fix"), ready, message);
  }

  SimMount mount_;
  sim::Gnss gnss_;
};

template <class Odometry>
class OdometrySource : public SimSource {
 public:
  template <class P>
  OdometrySource(const SimSetup& setup, const sim::Mount& mount, const P& params)
      : SimSource(params.rate),
        mount_(setup, mount),
        odometry_(params, setup.world.robot.way, setup.seedOf(mount.name)),
        tf_(setup.tf_odometry == mount.name) {}

 private:
  void measure(double time, const ros::Time& ready, const SimSink& sink) override {
    const sim::OdometrySample sample = odometry_.next();
    auto message = boost::make_shared<nav_msgs::Odometry>();
    message->header = mount_.header(time);
    message->child_frame_id = "base";
    message->pose.pose = tf2::toMsg(sample.T_odom_base);
    set(message->twist.twist.linear, sample.velocity);
    set(message->twist.twist.angular, sample.angular_rate);
    const double place = sample.sigma_position, tilt = sample.sigma_tilt;
    setDiagonal(message->pose.covariance, {place, place, sample.sigma_height, tilt, tilt, sample.sigma_yaw});
    const Eigen::Vector3d &v = sample.sigma_velocity, &w = sample.sigma_angular_rate;
    setDiagonal(message->twist.covariance, {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()});
    send(sink, mount_.name(), ready, message);
    if (!tf_) return;
    auto tf = boost::make_shared<tf2_msgs::TFMessage>();
    tf->transforms.push_back(
        transformMessage(message->header.stamp, mount_.name(), "base", sample.T_odom_base));
    send(sink, "/tf", ready, tf);
  }

  static void setDiagonal(boost::array<double, 36>& covariance, const std::array<double, 6>& sigma) {
    for (std::size_t i = 0; i < 6; ++i) covariance[7 * i] = variance(sigma[i]);
  }

  SimMount mount_;
  Odometry odometry_;
  bool tf_;
};

}  // namespace

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount, const sim::ImuParams& params) {
  return std::make_unique<ImuSource>(setup, mount, params);
}

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount, const sim::GnssParams& params) {
  return std::make_unique<GnssSource>(setup, mount, params);
}

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount,
                                     const sim::WheelOdometryParams& params) {
  return std::make_unique<OdometrySource<sim::WheelOdometry>>(setup, mount, params);
}

std::unique_ptr<SimSource> simSensor(const SimSetup& setup, Mounted mount,
                                     const sim::LegOdometryParams& params) {
  return std::make_unique<OdometrySource<sim::LegOdometry>>(setup, mount, params);
}

}  // namespace field_fusion
