#include "field_fusion/ros/motion_source.h"

#include <tf2_eigen/tf2_eigen.h>

#include <stdexcept>

namespace field_fusion {
namespace {

bool still(const core::Sweep& sweep) { return sweep.end == sweep.begin; }

}  // namespace

void MotionSource::setParams(const MotionParams& params) {
  history_.setParams(params.history);
  inertial_.setParams(params.inertial);
  params_ = params;
}

void MotionSource::reset() {
  history_.clear();
  inertial_.reset();
}

void MotionSource::add(const std_msgs::Header& header, const std::string& frame, core::TimedPose pose) {
  if (frame != frame_) history_.clear();  // poses of two bodies do not mix
  frame_ = frame;
  pose.time = header.stamp.toSec();
  history_.add(pose);
}

void MotionSource::add(const nav_msgs::Odometry& odometry) {
  const auto& frame = params_.base_frame.empty() ? odometry.child_frame_id : params_.base_frame;
  if (frame.empty()) throw std::runtime_error("pose damaged: no child_frame_id, and base_frame is not set");
  core::TimedPose pose;
  tf2::fromMsg(odometry.pose.pose.position, pose.position);
  tf2::fromMsg(odometry.pose.pose.orientation, pose.rotation);
  add(odometry.header, frame, pose);
}

void MotionSource::add(const sensor_msgs::Imu& imu) {
  Eigen::Vector3d rate, force;
  tf2::fromMsg(imu.angular_velocity, rate);
  tf2::fromMsg(imu.linear_acceleration, force);
  add(imu.header, imu.header.frame_id, inertial_.add(imu.header.stamp.toSec(), rate, force));
}

bool MotionSource::ready(const std_msgs::Header& header, const core::Sweep& sweep, const TfCache& tf) const {
  if (still(sweep)) return true;
  const double stamp = header.stamp.toSec();
  const auto cover = history_.cover(stamp + sweep.begin, stamp + sweep.end);
  if (cover == core::PoseHistory::Cover::kNotYet) return false;
  return cover != core::PoseHistory::Cover::kWhole || tf.has(frame_, header);
}

std::string MotionSource::follow(const std_msgs::Header& header, const core::Sweep& sweep, const TfCache& tf,
                                 core::MotionTrack& track) const {
  const double instant = sweep.at(params_.instant);
  if (still(sweep)) {
    track.keepOn(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), sweep, instant);
    return "";
  }
  const double stamp = header.stamp.toSec();
  const auto cover = history_.cover(stamp + sweep.begin, stamp + sweep.end);
  if (cover != core::PoseHistory::Cover::kWhole) return std::string("its motion ") + describe(cover);
  try {
    track.follow(history_, stamp, sweep, instant, tf.lookup(frame_, header));
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

void describeRaw(const FaultLog& raw, const std::string& what, diagnostic_updater::DiagnosticStatusWrapper& status) {
  constexpr double kShown = 5.0;  // [s] of wall time
  if (raw.age() < kShown)
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, what + " are passed on raw, " + raw.last());
  status.add(what + " passed on raw", raw.total());
  for (const auto& [why, count] : raw.byKind()) status.add(what + " passed on raw, " + why, count);
}

}  // namespace field_fusion
