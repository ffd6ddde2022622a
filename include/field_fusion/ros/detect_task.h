#pragma once
// From an image message to its detections, in one call that may run in any thread.
#include <sensor_msgs/Image.h>

#include <memory>

#include "field_fusion/ros/detection.h"
#include "field_fusion/ros/latest_worker.h"

namespace field_fusion {

/// One image to look at, with all that belongs to it.
struct DetectJob {
  sensor_msgs::Image::ConstPtr image;
  std::shared_ptr<const CameraModel> camera;  ///< null: no bearing, no range
  core::Plane ground;                         ///< in the optical frame; NaN: unknown
  std::shared_ptr<const core::DetectParams> params;
  bool annotate = false;
  ros::WallTime arrival = ros::WallTime::now();
};

/// Its thread stays behind the LiDAR chain.
using DetectWorker = LatestWorker<DetectJob>;
constexpr int kDetectNiceness = 5;

struct DetectResult {
  boost::shared_ptr<ImageDetectionArray> detections;
  boost::shared_ptr<sensor_msgs::Image> annotated;  ///< null unless the job asked for it
};

/// Runs the detector on a job. Not thread-safe. Throws std::runtime_error on an image that cannot be read.
class DetectTask {
 public:
  /// Throws std::runtime_error on a model or class file that cannot be used.
  explicit DetectTask(const core::DetectParams& params);
  DetectResult operator()(const DetectJob& job);

 private:
  DetectTask(const core::OnnxFile& model, const core::DetectParams& params);

  core::YoloDetector detector_;
};

}  // namespace field_fusion
