// A made-up scene -> a bag with clouds, images, detections and the truth, for a demonstration that needs
// neither a recording nor a detector's model.
#include <cv_bridge/cv_bridge.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <opencv2/imgproc.hpp>

#include "field_fusion/ObstacleArray.h"
#include "field_fusion/core/sim/scene_camera.h"
#include "field_fusion/core/sim/scene_lidar.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/detection.h"
#include "field_fusion/ros/recording.h"
#include "progress.h"

namespace {

using namespace field_fusion;

constexpr double kRate = 10.0;       // frames per second
constexpr double kStart = 1000.0;    // s, stamp of the first frame
constexpr double kMinVisible = 0.5;  // share of a body that the made-up detector needs to see
constexpr double kEdgeNoise = 1.0;   // px, its error at each edge of a box
constexpr double kMissed = 0.02;     // share of bodies that it overlooks
constexpr int kMinReturns = 10;      // that the LiDAR needs to have seen a body

const std::vector<std::string> kClasses{"person", "car", "truck"};

struct Options {
  std::string bag;
  double seconds = 10.0;
  unsigned seed = 1;
};

std_msgs::Header headerAt(const ros::Time& stamp, const char* frame) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

/// Says on the image where its boxes come from.
cv::Mat captioned(const cv::Mat& image) {
  cv::Mat out = image.clone();
  cv::putText(out, "made-up scene: detections by its generator, not by a detector", {12, out.rows - 14},
              cv::FONT_HERSHEY_SIMPLEX, 0.9, {255, 255, 255}, 2, cv::LINE_AA);
  return out;
}

/// What a detector that errs at the edges, and overlooks some, would say.
core::Detections detect(const core::Scene& scene, const core::ScenePicture& picture, std::mt19937& random) {
  std::normal_distribution<float> edge(0.f, kEdgeNoise), score(0.85f, 0.05f);
  std::bernoulli_distribution missed(kMissed);
  const cv::Size size = picture.image.size();
  core::Detections out;
  out.input_scale = core::RangeParams().box_pixel_error / kEdgeNoise;  // so that range_sigma tells this error
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const auto known = std::find(kClasses.begin(), kClasses.end(), scene[i].label);
    const core::View& view = picture.views[i];
    if (known == kClasses.end() || view.visible < kMinVisible || missed(random)) continue;
    core::Detection detection;
    detection.class_id = static_cast<int>(known - kClasses.begin());
    detection.score = std::clamp(score(random), 0.3f, 1.f);
    detection.box = {view.box.x_min + edge(random), view.box.y_min + edge(random),
                     view.box.x_max + edge(random), view.box.y_max + edge(random)};
    detection.box = core::clip(detection.box, size);
    detection.cut = core::cutBits(detection.box, size, 2.f);
    out.detections.push_back(detection);
  }
  return out;
}

/// Every body where it stands; its source tells which sensors can see it.
ObstacleArray truth(const core::Scene& scene, double time, const core::SceneScan& scan,
                    const core::ScenePicture& picture, const core::Transform& T_lidar_base) {
  ObstacleArray out;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::AlignedBox3d box = scene[i].boxAt(time);
    const Eigen::Vector3d position = T_lidar_base * box.center();
    const core::Polar polar = core::polar(position);
    Obstacle body;
    body.id = static_cast<std::uint32_t>(i);
    body.cluster_id = body.detection_id = -1;
    if (scan.body_points[i] >= kMinReturns) body.source |= Obstacle::SOURCE_LIDAR;
    if (picture.views[i].visible >= kMinVisible) body.source |= Obstacle::SOURCE_CAMERA;
    body.position.x = position.x(), body.position.y = position.y(), body.position.z = position.z();
    body.size.x = box.sizes().x(), body.size.y = box.sizes().y(), body.size.z = box.sizes().z();
    body.existence = body.label_probability = 1.f;
    body.label = scene[i].label;
    body.range = static_cast<float>(polar.range);
    body.azimuth = static_cast<float>(polar.azimuth);
    body.elevation = static_cast<float>(polar.elevation);
    body.range_difference = body.azimuth_difference = core::kNaN;
    out.obstacles.push_back(body);
  }
  return out;
}

/// The sensors, the scene before them, and the errors they make.
class Recorder {
 public:
  explicit Recorder(const Options& options)
      : bag_(options.bag), random_(options.seed), T_lidar_base_(lidar_.T_base_lidar.inverse()) {
    bag_.writeStatic({transformMessage(ros::Time(kStart), "base_link", "lidar", lidar_.T_base_lidar),
                      transformMessage(ros::Time(kStart), "lidar", "camera_optical",
                                       T_lidar_base_ * camera_.T_base_camera)});
  }

  void record(double time) {
    const ros::Time stamp = ros::Time(kStart) + ros::Duration(time);
    const std_msgs::Header lidar = headerAt(stamp, "lidar"), camera = headerAt(stamp, "camera_optical");
    const core::ScenePicture picture = core::picture(scene_, time, camera_);
    const sensor_msgs::CameraInfo info = cameraInfo(camera, camera_.pinhole, camera_.size);
    const CameraModel model(info);
    const auto detections = detectionMessage(camera, camera_.size, detect(scene_, picture, random_), kClasses,
                                             &model, core::Plane(), core::RangeParams());
    bag_.write("/image_raw", *cv_bridge::CvImage(camera, "bgr8", picture.image).toImageMsg());
    bag_.write("/camera_info", info);
    bag_.write("/detections", *detections);
    bag_.write("/annotated_image", *annotated({captioned(picture.image)}, *detections));

    core::SceneScan scan = core::scan(scene_, time, lidar_, random_);
    ObstacleArray bodies = truth(scene_, time, scan, picture, T_lidar_base_);
    bodies.header = lidar;
    CloudMessage cloud;
    cloud.header = lidar;
    cloud.points = std::move(scan.cloud);
    bag_.write("/points", cloud);
    bag_.write("/truth/obstacles", bodies);
  }

  void finish() { bag_.finish(); }

 private:
  Recording bag_;
  const core::Scene scene_ = core::quayScene();
  const core::SceneLidar lidar_;
  const core::SceneCamera camera_;
  std::mt19937 random_;
  const core::Transform T_lidar_base_;
};

void make(const Options& options) {
  Recorder recorder(options);
  const auto frames = static_cast<std::size_t>(std::max(1.0, std::round(options.seconds * kRate)));
  for (std::size_t i = 0; i < frames; ++i) {
    recorder.record(static_cast<double>(i) / kRate);
    showProgress(i + 1, frames);
  }
  recorder.finish();
  std::cout << options.bag << ": " << frames << " frames\n";
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes a bag of a made-up scene: sensors, detections, and the truth on /truth/obstacles.");
  app.add_option("bag", options.bag, "file to write")->required();
  app.add_option("--seconds", options.seconds, "length")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  app.add_option("--seed", options.seed, "of the sensors' errors")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    make(options);
  } catch (const std::exception& e) {
    std::cerr << "make_scene: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
