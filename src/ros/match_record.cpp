#include "field_fusion/ros/match_record.h"

#include <cmath>

#include "field_fusion/core/base/median.h"

namespace field_fusion {
namespace {

constexpr std::size_t kLast = 64, kEnough = 10;

double medianOf(const std::deque<double>& values) { return core::median({values.begin(), values.end()}); }

}  // namespace

void MatchRecord::add(const core::Sync::Frame& frame, double now) {
  if (frame.answered()) ages_.add(now - frame.stamp);
  if (!frame.clusters) return;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const double offset = frame.answers[i].offset;
    if (std::isnan(offset)) continue;
    cameras_[i].offsets.add(offset);
    cameras_[i].last.push_back(offset);
    if (cameras_[i].last.size() > kLast) cameras_[i].last.pop_front();
  }
}

void MatchRecord::add(double stamp, const std::vector<core::Obstacle>& obstacles) {
  for (const core::Obstacle& o : obstacles)
    if (o.source == core::ObstacleSource::kBoth)
      cameras_[static_cast<std::size_t>(o.camera)].alignment.add(
          stamp, {o.verdict.azimuth_difference, o.verdict.elevation_difference});
}

void MatchRecord::describeAlignment(const Camera& camera,
                                    diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const auto drift = camera.alignment.drift();
  if (!drift) return;
  const auto in_degrees = [](double angle) { return core::degrees(angle); };
  const Eigen::Array2d now = drift->now.unaryExpr(in_degrees), usual = drift->usual.unaryExpr(in_degrees);
  status.addf(camera.name + ": boxes off clusters, azimuth and elevation [deg]", "%.2f %.2f, at first %.2f %.2f",
              now.x(), now.y(), usual.x(), usual.y());
  if (!core::AlignmentWatch::isFault(*drift, params_.alignment)) return;
  status.mergeSummaryf(diagnostic_msgs::DiagnosticStatus::WARN,
                       "%s: boxes have shifted against clusters by %.2f deg in azimuth, %.2f in elevation (was a "
                       "sensor moved?)",
                       camera.name.c_str(), now.x() - usual.x(), now.y() - usual.y());
}

void MatchRecord::describe(const core::Sync::Counts& counts,
                           diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("pairs", counts.pairs);
  status.add("clusters alone", counts.alone);
  status.add("camera only", counts.camera_only);
  status.add("detections late", counts.late);
  status.add("waits cut short", counts.dropped);
  status.add("age of pairs [ms]", ages_.text(1e3));
  for (const Camera& camera : cameras_) {
    status.add(camera.name + ": offset to clusters [ms]", camera.offsets.text(1e3));
    describeAlignment(camera, status);
    if (camera.last.size() < kEnough) continue;
    const double offset = medianOf(camera.last);
    if (std::abs(offset) > params_.sync.max_interval / 2)
      status.mergeSummaryf(
          diagnostic_msgs::DiagnosticStatus::WARN,
          "%s: stamps of detections are mostly %.0f ms from those of clusters (time_offset?)",
          camera.name.c_str(), 1e3 * offset);
  }
}

void MatchRecord::reset() {
  cameras_.clear();
  for (std::size_t i = 0; i < params_.sync.cameraCount(); ++i)
    cameras_.push_back({params_.sync.cameras.empty() ? "camera" : params_.sync.cameras[i], {-0.25, 0.005, 100}, {}, {}});
  ages_.reset();
}

}  // namespace field_fusion
