// A recording in KITTI's layout -> a bag with clouds, images, camera and transforms.
#include <cv_bridge/cv_bridge.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "field_fusion/core/io/kitti.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/recording.h"
#include "progress.h"

namespace {

using namespace field_fusion;

constexpr double kLidarHeight = 1.73;  // m above the ground, Geiger et al. 2013

struct Options {
  std::string folder, bag;
  double rate = 10.0;           // frames per second
  double turn = 0.1;            // s that the scanner takes for one
  double start = 1317000000.0;  // s, stamp of the first frame: the month of the recordings
  int repeat = 1;
};

std_msgs::Header headerAt(const ros::Time& stamp, const char* frame) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

void writeSetup(Recording& bag, const ros::Time& stamp, const core::Transform& T_camera_lidar) {
  const core::Transform T_base_lidar(Eigen::Translation3d(0.0, 0.0, kLidarHeight));
  bag.writeStatic({transformMessage(stamp, "base_link", "lidar", T_base_lidar),
                   transformMessage(stamp, "lidar", "camera_optical", T_camera_lidar.inverse())});
}

void writeImage(Recording& bag, const ros::Time& stamp, const core::KittiFrame& frame,
                const core::Pinhole& camera) {
  const cv::Mat image = cv::imread(frame.image.string(), cv::IMREAD_COLOR);
  if (image.empty()) throw std::runtime_error("cannot read image " + frame.image.string());
  const std_msgs::Header header = headerAt(stamp, "camera_optical");
  bag.write("/image_raw", *cv_bridge::CvImage(header, "bgr8", image).toImageMsg());
  bag.write("/camera_info", cameraInfo(header, camera, image.size()));
}

void writeCloud(Recording& bag, const ros::Time& stamp, const core::KittiFrame& frame, double turn) {
  CloudMessage cloud;
  cloud.header = headerAt(stamp, "lidar");
  cloud.points = core::readKittiCloud(frame.cloud, turn);
  bag.write("/points", cloud);
}

void convert(const Options& options) {
  const std::vector<core::KittiFrame> frames = core::listKitti(options.folder);
  const bool images = !frames.front().image.empty();
  if (!images) std::cout << options.folder << " has no images: the bag gets clouds only\n";

  Recording bag(options.bag);
  std::optional<core::Transform> written;  // the T_camera_lidar that the bag has
  const std::size_t count = frames.size() * static_cast<std::size_t>(options.repeat);
  for (std::size_t i = 0; i < count; ++i) {
    const core::KittiFrame& frame = frames[i % frames.size()];
    const ros::Time stamp = ros::Time(options.start) + ros::Duration(static_cast<double>(i) / options.rate);
    const core::KittiCalibration calibration = core::readKittiCalibration(frame.calibration);
    if (!written ||
        !calibration.T_camera_lidar.isApprox(*written)) {  // KITTI's object benchmark mixes drives
      written = calibration.T_camera_lidar;
      writeSetup(bag, stamp, *written);
    }
    if (images) writeImage(bag, stamp, frame, calibration.camera);
    writeCloud(bag, stamp, frame, options.turn);
    showProgress(i + 1, count);
  }
  bag.finish();
  std::cout << options.bag << ": " << count << " frames\n";
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Turns a recording in KITTI's layout into a bag: /points, /image_raw, /camera_info, /tf_static.");
  app.add_option("folder", options.folder, "with velodyne/, image_02/ or image_2/, calib.txt or calib/")
      ->required();
  app.add_option("bag", options.bag, "file to write")->required();
  app.add_option("--rate", options.rate, "frames per second")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--turn", options.turn, "time that the scanner takes for one turn [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 10.0));
  app.add_option("--start", options.start, "stamp of the first frame [s]")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 4.0e9));
  app.add_option("--repeat", options.repeat, "times that the frames are written, stamps going on")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, argc, argv);
  try {
    convert(options);
  } catch (const std::exception& e) {
    std::cerr << "kitti_to_bag: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
