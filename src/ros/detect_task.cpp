#include "field_fusion/ros/detect_task.h"

#include <ros/console.h>

namespace field_fusion {

DetectTask::DetectTask(const core::DetectParams& params)
    : detector_(core::readOnnxFile(params.model), params.class_file, params.inference) {
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
