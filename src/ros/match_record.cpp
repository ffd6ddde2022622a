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
    if (camera.last.size() < kEnough) continue;
    const double offset = medianOf(camera.last);
    if (std::abs(offset) > params_.max_interval / 2)
      status.mergeSummaryf(
          diagnostic_msgs::DiagnosticStatus::WARN,
          "%s: stamps of detections are mostly %.0f ms from those of clusters (time_offset?)",
          camera.name.c_str(), 1e3 * offset);
  }
}

void MatchRecord::reset() {
  cameras_.clear();
  for (std::size_t i = 0; i < params_.cameraCount(); ++i)
    cameras_.push_back({params_.cameras.empty() ? "camera" : params_.cameras[i], {-0.25, 0.005, 100}, {}});
  ages_.reset();
}

}  // namespace field_fusion
