#pragma once
// From messages of scans to scans and clouds of one instant.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <sensor_msgs/LaserScan.h>

#include "field_fusion/core/scan/deskew.h"
#include "field_fusion/core/scan/sweep_clock.h"
#include "field_fusion/core/scan/vicp.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/motion_source.h"

namespace field_fusion {

struct DeskewScanParams {
  enum class Method { kOdometry, kVicp, kImu };
  Method method = Method::kOdometry;
  MotionParams motion;
  double sweep_time = 0.0;
  double stamp_offset = 0.0;
  core::VicpParams vicp;

  void declare(core::Params& p) {
    p.choice(
        "method", method, {"odometry", "vicp", "imu"}, core::When::kStart,
        "What tells the motion: poses of the odometry (MDR of paper 004), the scans themselves, or gyroscope "
        "and accelerometer; the last two are the rivals of the paper.");
    motion.declare(p);
    p.number("sweep_time", sweep_time, {0.0, 100.0}, "s", core::When::kLive,
             "How long the scanner takes for a full turn; 0: by time_increment of the scan.");
    p.number("stamp_offset", stamp_offset, {-10.0, 10.0}, "s", core::When::kLive,
             "Time of the first beam after the stamp; -sweep_time for a driver that stamps the end.");
    vicp.declare(p);
  }
};

class ScanFlow {
 public:
  struct Output {
    sensor_msgs::LaserScan::ConstPtr scan;
    CloudMessage::ConstPtr points;
    bool log = false;  ///< it is time to write `raw()` to the log
  };

  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const DeskewScanParams& params);
  MotionSource& motion() { return motion_; }

  /// False while the scan waits for what tells the motion; a damaged scan does not wait.
  bool ready(const sensor_msgs::LaserScan& message, const TfCache& tf);

  /// The scan and its points at one instant, with the stamp of that; where the motion is not known the very
  /// message, and its points with their times. Throws std::runtime_error "scan damaged: ...", and why the
  /// motion is not known where the parameters say so.
  Output run(const sensor_msgs::LaserScan::ConstPtr& message, const TfCache& tf);

  const std::string& raw() const { return raw_.last(); }  ///< why the last scan that was raw was so
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reset();

 private:
  void take(const sensor_msgs::LaserScan& message);
  std::string follow(const std_msgs::Header& header, const TfCache& tf);

  DeskewScanParams params_;
  MotionSource motion_;
  core::Vicp vicp_;
  core::SweepClock clock_;
  core::ScanDeskewer deskewer_;
  core::MotionTrack track_;
  core::Scan scan_, binned_;  // of the message in hand
  ros::Time stamp_;           // of it
  core::SweepTiming timing_;
  core::Sweep sweep_;
  core::DeskewCounts counts_;
  core::Cloud raw_points_;
  FaultLog raw_;
};

}  // namespace field_fusion
