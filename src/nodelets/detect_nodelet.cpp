// image, camera_info, ground_plane -> [YOLOv8, bearing, monocular range] -> detections, annotated_image
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/camera_feed.h"
#include "field_fusion/ros/detect_task.h"
#include "field_fusion/ros/ground_feed.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class DetectNodelet : public StageNodelet<core::DetectParams> {
  void onStart() override {
    onParams();
    task_ = std::make_unique<DetectTask>(params());
    worker_ = std::make_unique<DetectWorker>([this](DetectJob&& job) { work(job); }, kDetectNiceness);
    detections_ = output<ImageDetectionArray>("detections");
    annotated_ = output<sensor_msgs::Image>("annotated_image");
    info_ = &input<sensor_msgs::CameraInfo>("camera_info", [this](const auto& info) { camera_.add(*info); });
    plane_ = &input<GroundPlane>("ground_plane", [this](const auto& plane) { ground_.add(plane); });
    const auto take = [this](const auto& image) { onImage(image); };
    image_ = &imageInput("image", take, [this](const auto& i) { return camera_.ready(i.header.stamp); });
    plane_->optional = image_->deferred = true;
    info_->optional = camera_.readFile(getPrivateNodeHandle(), params().camera_info_url);
  }
  void onParams() override { settings_ = std::make_shared<const core::DetectParams>(params()); }
  void onTimeJump() override { worker_->clear(), camera_.reset(), ground_.reset(); }

  void onImage(const sensor_msgs::Image::ConstPtr& image) {
    std::string no_camera, no_ground;  // the image is good: its boxes go out with what is known
    const auto camera = camera_.modelFor(*image, no_camera);
    const auto ground = ground_.planeFor(image->header, tf(), params().range.plane_max_age, no_ground);
    if (!camera) fault(*info_, image->header.stamp, no_camera);
    if (!no_ground.empty()) fault(*plane_, image->header.stamp, no_ground);
    if (worker_->offer({image, camera, ground, settings_, !annotated_.unwanted()})) ++image_->skipped;
  }

  void work(const DetectJob& job) {
    complete(
        *image_, job.image->header.stamp, job.arrival, [&] { return (*task_)(job); },
        [this](const DetectResult& result) {
          detections_.publish(result.detections);
          if (result.annotated) annotated_.publish(result.annotated);
        });
  }

  Output<ImageDetectionArray> detections_;
  Output<sensor_msgs::Image> annotated_;
  InputPort *image_ = nullptr, *info_ = nullptr, *plane_ = nullptr;
  CameraFeed camera_;
  GroundFeed ground_;
  std::shared_ptr<const core::DetectParams> settings_;
  std::unique_ptr<DetectTask> task_;
  std::unique_ptr<DetectWorker> worker_;  // last: its thread uses all of the above
};
using DetectStage = Unloadable<DetectNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::DetectStage, nodelet::Nodelet)
