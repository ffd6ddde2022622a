// image, camera_info -> [YOLOv8, bearing, monocular range] -> detections, annotated_image
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/camera_feed.h"
#include "field_fusion/ros/detect_task.h"
#include "field_fusion/ros/latest_worker.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class DetectNodelet : public StageNodelet<core::DetectParams> {
  void onStart() override {
    onParams();
    task_ = std::make_unique<DetectTask>(params());
    worker_ = std::make_unique<LatestWorker<DetectJob>>([this](DetectJob&& job) { work(job); }, kNiceness);
    detections_ = output<ImageDetectionArray>("detections");
    annotated_ = output<sensor_msgs::Image>("annotated_image");
    info_ = &input<sensor_msgs::CameraInfo>("camera_info", [this](const auto& info) { camera_.add(*info); });
    const auto ready = [this](const auto& image) { return camera_.ready(image.header.stamp); };
    image_ = &imageInput(
        "image", [this](const auto& image) { onImage(image); }, ready);
    image_->deferred = true;
  }

  void onParams() override { settings_ = std::make_shared<const core::DetectParams>(params()); }
  void onTimeJump() override { worker_->clear(), camera_.reset(); }

  void onImage(const sensor_msgs::Image::ConstPtr& image) {
    std::string no_camera;
    const auto camera = camera_.modelFor(*image, no_camera);
    // the image is good: its boxes go out without bearing
    if (!camera) fault(*info_, image->header.stamp, no_camera);
    if (worker_->offer({image, camera, settings_, ros::WallTime::now(), !annotated_.unwanted()}))
      ++image_->skipped;
  }

  void work(const DetectJob& job) {
    complete(
        *image_, job.image->header.stamp, job.arrival, [&] { return (*task_)(job); },
        [this](const DetectResult& result) {
          detections_.publish(result.detections);
          if (result.annotated) annotated_.publish(result.annotated);
        });
  }

  static constexpr int kNiceness = 5;  // behind the LiDAR chain
  Output<ImageDetectionArray> detections_;
  Output<sensor_msgs::Image> annotated_;
  InputPort *image_ = nullptr, *info_ = nullptr;
  CameraFeed camera_;
  std::shared_ptr<const core::DetectParams> settings_;
  std::unique_ptr<DetectTask> task_;
  std::unique_ptr<LatestWorker<DetectJob>> worker_;  // last: its thread uses all of the above
};
using DetectStage = Unloadable<DetectNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::DetectStage, nodelet::Nodelet)
