#pragma once
// From messages of clouds to clouds of one instant.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "field_fusion/core/cloud/deskew.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/motion_source.h"

namespace field_fusion {

struct DeskewCloudParams {
  enum class Method { kOdometry, kImu };
  Method method = Method::kOdometry;
  MotionParams motion;

  void declare(core::Params& p) {
    p.choice(
        "method", method, {"odometry", "imu"}, core::When::kStart,
        "What tells the motion: poses of the odometry (MDR of paper 004), or gyroscope and accelerometer.");
    motion.declare(p);
  }
};

class CloudFlow {
 public:
  struct Output {
    CloudMessage::ConstPtr points;
    bool log = false;  ///< it is time to write `raw()` to the log
  };

  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const DeskewCloudParams& params);
  MotionSource& motion() { return motion_; }

  /// False while the cloud waits for what tells the motion.
  bool ready(const CloudMessage& message, const TfCache& tf);

  /// The points at one instant, with the stamp of that; where the motion is not known the very message.
  /// Throws std::runtime_error with the reason why it is not known where the parameters say so.
  Output run(const CloudMessage::ConstPtr& message, const TfCache& tf);

  const std::string& raw() const { return raw_.last(); }  ///< why the last cloud that was raw was so
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reset();

 private:
  void take(const CloudMessage& message);

  DeskewCloudParams params_;
  MotionSource motion_;
  core::MotionTrack track_;
  ros::Time stamp_;  // of the message in hand
  core::CloudSweep sweep_;
  FaultLog raw_;
};

}  // namespace field_fusion
