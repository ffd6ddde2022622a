#include "field_fusion/ros/slam_flow.h"

#include <boost/make_shared.hpp>

#include "field_fusion/core/map/particle_weights.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/save_map.h"
#include "field_fusion/ros/scan_message.h"

namespace field_fusion {
namespace {

constexpr double kMostTilt = 20.0;  // [deg] of a scanner

/// Throws std::runtime_error with the file's name.
core::TileMap loadedMap(const std::string& file, const core::GridSlamParams& p, const core::Pose2& start) {
  const core::Occupancy map = core::readMap(file);
  try {
    const double x = (start.x - map.x) / map.resolution, y = (start.y - map.y) / map.resolution;
    if (!(x >= 0.0 && x < map.width && y >= 0.0 && y < map.height))
      throw std::runtime_error("start_x and start_y lie outside of it");
    return core::tileMapOf(map, p.resolution, static_cast<float>(p.occupied));
  } catch (const std::exception& e) {
    throw std::runtime_error("map " + file + ": " + e.what());
  }
}

/// Throws std::runtime_error for a scanner that does not look along the robot's floor: its map would be nonsense.
void requireFlat(const core::Transform& T_base_sensor, const std::string& frame) {
  const double tilt = core::degrees(std::acos(std::min(1.0, std::abs(T_base_sensor.linear()(2, 2)))));
  if (tilt > kMostTilt)
    throw std::runtime_error("the scanner " + frame + " is tilted by " + std::to_string(std::lround(tilt)) +
                             " deg: it must lie in the plane of base_frame, upside down or not");
}

constexpr double kShown = 10.0;  // [s, stamps] that a mishap keeps the status at WARN

core::ScanLimits limitsOf(const core::GridSlamParams& p) { return {p.min_range, p.usable_range, p.max_range}; }

}  // namespace

void SlamFlow::setParams(const SlamStageParams& params) {
  params_ = params;
  if (slam_) return slam_->setLive(params.slam);
  slam_ = std::make_unique<core::GridSlam>(params.slam);
  broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  drawer_ = core::OccupancyDrawer(params.slam.resolution);
  if (!params.map_file.empty())
    loaded_ = loadedMap(params.map_file, params.slam, params.start().mean);
  reset();
}

void SlamFlow::reset() {
  params_.map_file.empty() ? slam_->reset() : slam_->reset(loaded_, params_.start());
  drawer_.reset(), local_.clear();
  last_blind_ = jumped_ = false;
  header_ = {}, drawn_ = {}, misfit_ = {}, odometry_jump_ = {};
  header_.frame_id = params_.map_frame;
}

bool SlamFlow::ready(const std_msgs::Header& header, const TfCache& tf) const {
  return tf.has(params_.base_frame, header) && tf.has(params_.odom_frame, params_.base_frame, header.stamp);
}

SlamFlow::News SlamFlow::run(const sensor_msgs::LaserScan& message, const TfCache& tf) {
  const core::Transform T_base_sensor = tf.lookup(params_.base_frame, message.header);
  requireFlat(T_base_sensor, message.header.frame_id);
  if (jumped_ && message.header.stamp <= header_.stamp) reset();
  jumped_ = false;
  const core::Pose2 T_odom_base = core::flat(tf.lookup(params_.odom_frame, params_.base_frame, message.header.stamp));
  const core::SlamScan scan = core::slamScan(scanOf(message), T_base_sensor, limitsOf(params_.slam));
  const auto jumps = slam_->odometryJumps();
  using Outcome = core::GridSlam::Outcome;
  const Outcome outcome =
      slam_->process(scan, T_odom_base, static_cast<std::int64_t>(message.header.stamp.toNSec()));
  header_.stamp = message.header.stamp;
  if (slam_->odometryJumps() != jumps) odometry_jump_ = header_.stamp;
  last_blind_ = scan.hits.empty();
  if (outcome == Outcome::kBlind) ++blind_;
  if (outcome != Outcome::kProcessed && !slam_->best().path) return {};
  sendTransform(T_odom_base);
  if (outcome == Outcome::kSkipped) return {};
  local_.add(scan, slam_->best().path.get(), params_.local_way);
  if (outcome == Outcome::kBlind) return {};
  ++taken_;
  noteFit();
  const bool due = drawn_.isZero() || (header_.stamp - drawn_).toSec() >= params_.map_update_interval;
  if (due) drawn_ = header_.stamp;
  return {true, due};
}

/// The map takes the scan in where it is: later ones may fit that, so one is told of for a while.
void SlamFlow::noteFit() {
  if (slam_->fit() >= params_.misfit) return;
  ++misfits_, misfit_ = header_.stamp;
}

void SlamFlow::sendTransform(const core::Pose2& T_odom_base) {
  if (!params_.publish_tf) return;
  const core::Pose2 T_map_odom = slam_->pose() * core::inverse(T_odom_base);
  broadcaster_->sendTransform(transformMessage(header_.stamp + ros::Duration(params_.tf_delay), params_.map_frame,
                                               params_.odom_frame, solid(T_map_odom)));
}

boost::shared_ptr<nav_msgs::OccupancyGrid> SlamFlow::localMap() {
  return gridMessage(header_, local_.draw(slam_->best().path.get(), params_.slam.resolution, params_.local_size));
}

void SlamFlow::answer(nav_msgs::GetMap::Response& answer) {
  const auto drawn = map();
  if (drawn->data.empty()) throw std::runtime_error("there is no map yet");
  answer.map = *drawn;
}

void SlamFlow::save(const SaveMap::Request& request, SaveMap::Response& answer) {
  saveMap(request, answer, [this](const std::string& file) {
    const core::Occupancy& drawn = drawer_.update(slam_->best().map);
    if (drawn.cells.empty()) throw std::runtime_error("there is no map yet");
    core::writeMap(file, drawn);
  });
}

boost::shared_ptr<std_msgs::Float64> SlamFlow::entropy() const {
  const auto out = boost::make_shared<std_msgs::Float64>();
  out->data = core::entropy(slam_->weights());
  return out;
}

void SlamFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  const auto isRecent = [&](const ros::Time& at) { return !at.isZero() && (header_.stamp - at).toSec() < kShown; };
  if (isRecent(odometry_jump_)) status.mergeSummary(DiagnosticStatus::WARN, "odometry has jumped");
  if (isRecent(misfit_))
    status.mergeSummary(DiagnosticStatus::WARN, "a scan did not fit the map: has the robot been carried?");
  if (last_blind_) status.mergeSummary(DiagnosticStatus::WARN, "the last scan has no return between min_range and maxUrange");
  status.add("scans taken into the map", taken_);
  status.add("scans that did not fit it", misfits_);
  status.add("last scan: share that fits", slam_->fit());
  status.add("scans without any return", blind_);
  status.add("jumps of the odometry", slam_->odometryJumps());
  status.add("particles that count (N_eff)", slam_->effective());
}

}  // namespace field_fusion
