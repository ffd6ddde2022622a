#include "field_fusion/ros/detect_task.h"

#include <ros/console.h>

#include "field_fusion/core/detect/class_names.h"

namespace field_fusion {

DetectTask::DetectTask(const core::DetectParams& params)
    : DetectTask(core::readOnnxFile(params.model), params) {}

DetectTask::DetectTask(const core::OnnxFile& model, const core::DetectParams& params)
    : detector_(model, params.class_file, params.inference) {
  const auto contradiction = core::contradictionOf(model, detector_.classNames());
  if (!contradiction.empty()) ROS_WARN_STREAM("class file '" << params.class_file << "': " << contradiction);
  ROS_INFO_STREAM("the detector runs on " << detector_.backend());
}

DetectResult DetectTask::operator()(const DetectJob& job) {
  const auto view = viewOf(job.image);
  const auto& found = detector_.detect(view.pixels, view.order, job.params->yolo);
  DetectResult result;
  result.detections = detectionMessage(job.image->header, view.pixels.size(), found, detector_.classNames(),
                                       job.camera.get(), job.ground, job.params->range);
  if (job.annotate) result.annotated = annotated(view, *result.detections);
  return result;
}

}  // namespace field_fusion
