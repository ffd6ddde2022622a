#include "field_fusion/ros/detect_task.h"

namespace field_fusion {

DetectResult DetectTask::operator()(const DetectJob& job) {
  const auto view = viewOf(job.image);
  const auto& found = detector_.detect(view.pixels, view.order, job.params->yolo);
  DetectResult result;
  result.detections = detectionMessage(job.image->header, view.pixels.size(), found, detector_.classNames(),
                                       job.camera.get(), job.params->range);
  if (job.annotate) result.annotated = annotated(view, *result.detections);
  return result;
}

}  // namespace field_fusion
