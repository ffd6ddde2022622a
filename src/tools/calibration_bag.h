#pragma once
// What the calibrations take from a bag.
#include <cv_bridge/cv_bridge.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "field_fusion/core/calib/camera_imu.h"
#include "field_fusion/core/cloud/deskew.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/scan_message.h"
#include "open_bag.h"
#include "progress.h"

namespace field_fusion {

/// A cloud or scan; a scan's points have z = 0.
struct LaserFrame {
  std::string frame;
  double begin = 0.0, end = 0.0;  ///< [s]
  core::Cloud cloud;
};

class CalibrationBag {
 public:
  /// Throws std::runtime_error where the file is no bag.
  explicit CalibrationBag(const std::string& file) : file_(file) {
    openBag(bag_, file);
    rosbag::View all(bag_);
    for (const rosbag::ConnectionInfo* c : all.getConnections()) types_[c->topic] = c->datatype;
  }

  /// `wanted`, or the only topic that has one of these types. Throws std::runtime_error with those there are.
  std::string topic(const std::string& wanted, const std::string& option, const std::set<std::string>& types) const {
    std::string names;
    std::vector<std::string> fit;
    for (const auto& [name, type] : types_)
      if (types.count(type)) fit.push_back(name), names += (names.empty() ? "" : ", ") + name;
    const std::string those = names.empty() ? "there is none" : "there are " + names;
    if (wanted.empty() && fit.size() != 1) throw std::runtime_error(file_ + ": " + option + " is needed; " + those);
    if (!wanted.empty() && !std::count(fit.begin(), fit.end(), wanted))
      throw std::runtime_error(file_ + ": " + option + " " + wanted + " is no topic of that type; " + those);
    return wanted.empty() ? fit.front() : wanted;
  }

  /// For messages of faults: which of the bag's.
  std::string name(const std::string& topic) const { return file_ + ": " + topic; }

  template <class Message>
  typename Message::ConstPtr first(const std::string& topic) {
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& m : view) return m.instantiate<Message>();
    throw std::runtime_error(file_ + ": " + topic + " has no messages");
  }

  /// Each picture in its order: bgr8 and its stamp [s]; `take` gets done and all.
  void pictures(const std::string& topic,
                const std::function<void(double, const cv::Mat&, std::size_t, std::size_t)>& take) {
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    std::size_t done = 0;
    for (const rosbag::MessageInstance& m : view) {
      ++done;
      if (const auto image = m.instantiate<sensor_msgs::Image>())
        take(image->header.stamp.toSec(), pixels(topic, *image), done, view.size());
      else if (const auto packed = m.instantiate<sensor_msgs::CompressedImage>())
        take(packed->header.stamp.toSec(), pixels(topic, *packed), done, view.size());
    }
  }

  /// Of an inertial unit, in their order; `frame` is that of the last.
  std::vector<core::ImuReading> readings(const std::string& topic, std::string& frame) {
    std::vector<core::ImuReading> out;
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& m : view) {
      const auto imu = m.instantiate<sensor_msgs::Imu>();
      const auto &w = imu->angular_velocity, &a = imu->linear_acceleration;
      out.push_back({imu->header.stamp.toSec(), {w.x, w.y, w.z}, {a.x, a.y, a.z}});
      frame = imu->header.frame_id;
    }
    try {
      core::checkReadings(out);
    } catch (const std::invalid_argument& e) {
      throw std::runtime_error(name(topic) + ", " + e.what());
    }
    requireFrame(topic, frame);
    return out;
  }

  void frames(const std::string& topic, const std::function<void(const LaserFrame&)>& take) {
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    const auto given = [&](const LaserFrame& frame) {
      requireFrame(topic, frame.frame);
      take(frame);
    };
    for (const rosbag::MessageInstance& m : view) {
      if (const auto scan = m.instantiate<sensor_msgs::LaserScan>())
        given(ofScan(topic, *scan));
      else if (const auto cloud = m.instantiate<CloudMessage>())
        given(ofCloud(topic, *cloud));
    }
  }

  /// What is found could not be told where one of the sensors has no frame.
  void requireFrame(const std::string& topic, const std::string& frame) const {
    if (frame.empty()) throw std::runtime_error(name(topic) + ": header.frame_id is empty");
  }

  /// T_target_source by /tf_static; nothing where it does not link them.
  std::optional<core::Transform> staticTransform(const std::string& target, const std::string& source) {
    tf2::BufferCore buffer;
    rosbag::View view(bag_, rosbag::TopicQuery("/tf_static"));
    for (const rosbag::MessageInstance& m : view)
      if (const auto message = m.instantiate<tf2_msgs::TFMessage>())
        for (const auto& transform : message->transforms) buffer.setTransform(transform, file_, true);
    try {
      return tf2::transformToEigen(buffer.lookupTransform(target, source, ros::Time(0)));
    } catch (const tf2::TransformException&) {
      return {};
    }
  }

 private:
  /// Throws std::runtime_error that names the picture.
  template <class Image>
  cv::Mat pixels(const std::string& topic, const Image& image) const try {
    return cv_bridge::toCvCopy(image, "bgr8")->image;
  } catch (const std::exception& e) {  // cv_bridge's, or OpenCV's
    throw std::runtime_error(name(topic) + ", stamp " + std::to_string(image.header.stamp.toSec()) + ": " + e.what());
  }

  void refuse(const std::string& topic, const std_msgs::Header& header, const std::string& fault) const {
    if (!fault.empty())
      throw std::runtime_error(name(topic) + ", stamp " + std::to_string(header.stamp.toSec()) + ": " + fault);
  }

  LaserFrame ofCloud(const std::string& topic, const CloudMessage& message) const {
    refuse(topic, message.header, message.fault);
    constexpr double kTurn = 0.1;  // [s] of a cloud that tells no times
    LaserFrame out{message.header.frame_id, message.header.stamp.toSec(), 0.0, message.points};
    const core::CloudSweep sweep = core::sweepOf(message.points);
    out.end = out.begin + (sweep.known ? sweep.sweep.end : kTurn);
    return out;
  }

  LaserFrame ofScan(const std::string& topic, const sensor_msgs::LaserScan& scan) const {
    try {
      scanOf(scan);
    } catch (const std::runtime_error& e) {
      refuse(topic, scan.header, e.what());
    }
    LaserFrame out{scan.header.frame_id, scan.header.stamp.toSec(), 0.0, {}};
    out.end = out.begin + static_cast<double>(scan.time_increment) * static_cast<double>(scan.ranges.size());
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const double range = scan.ranges[i];
      if (!(range >= scan.range_min && range <= scan.range_max)) continue;
      const double angle = scan.angle_min + static_cast<double>(i) * static_cast<double>(scan.angle_increment);
      core::Point point;
      point.x = static_cast<float>(range * std::cos(angle)), point.y = static_cast<float>(range * std::sin(angle));
      point.ring = 0;
      out.cloud.push_back(point);
    }
    return out;
  }

  rosbag::Bag bag_;
  std::string file_;
  std::map<std::string, std::string> types_;
};

/// Throws std::runtime_error for a camera that was never calibrated or has a lens of another model.
inline core::CameraLens lensOf(const sensor_msgs::CameraInfo& info) {
  core::CameraLens lens{{info.K[0], info.K[4], info.K[2], info.K[5]}, {}};
  for (const double k : info.K)
    if (!std::isfinite(k)) throw std::runtime_error("camera info is not finite: K");
  if (!lens.pinhole.known()) throw std::runtime_error("camera info is not calibrated: K has no focal lengths");
  const bool straight = std::all_of(info.D.begin(), info.D.end(), [](double d) { return d == 0.0; });
  if (!straight && info.distortion_model != "plumb_bob" && info.distortion_model != "rational_polynomial")
    throw std::runtime_error("camera info has the distortion model " + info.distortion_model +
                             "; plumb_bob and rational_polynomial are understood");
  if (info.D.size() > lens.distortion.size())
    throw std::runtime_error("camera info has " + std::to_string(info.D.size()) + " coefficients of distortion, 8 at most");
  std::copy(info.D.begin(), info.D.end(), lens.distortion.begin());
  for (const double d : lens.distortion)
    if (!std::isfinite(d)) throw std::runtime_error("camera info is not finite: D");
  return lens;
}

/// The camera of a recording.
struct BagCamera {
  std::string image, frame;  ///< topic of its pictures; as its camera info says
  core::CameraLens lens;
  cv::Size size;
};

/// By the options --image and --camera-info, both empty where there is only one.
inline BagCamera cameraOf(CalibrationBag& bag, const std::string& image, const std::string& camera_info) {
  BagCamera out;
  out.image = bag.topic(image, "--image", {"sensor_msgs/Image", "sensor_msgs/CompressedImage"});
  const std::string topic = bag.topic(camera_info, "--camera-info", {"sensor_msgs/CameraInfo"});
  const auto info = bag.first<sensor_msgs::CameraInfo>(topic);
  try {
    out.lens = lensOf(*info);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(bag.name(topic) + ": " + e.what());
  }
  out.frame = info->header.frame_id;
  bag.requireFrame(topic, out.frame);
  out.size = cv::Size(static_cast<int>(info->width), static_cast<int>(info->height));
  return out;
}

/// The corners in one of `every` pictures where the whole board is seen; `seen` gets the number looked at.
inline std::vector<core::Sighting> sightingsOf(CalibrationBag& bag, const BagCamera& camera, const core::Board& board,
                                               std::size_t every, std::size_t& seen) {
  std::vector<core::Sighting> out;
  seen = 0;
  bag.pictures(camera.image, [&](double stamp, const cv::Mat& image, std::size_t done, std::size_t all) {
    showProgress(done, all, "pictures");
    if (image.size() != camera.size)
      throw std::runtime_error(bag.name(camera.image) + ", stamp " + std::to_string(stamp) + ": a picture of " +
                               std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels, camera info says " +
                               std::to_string(camera.size.width) + " x " + std::to_string(camera.size.height));
    if ((done - 1) % every != 0) return;
    ++seen;
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    if (const auto view = core::findBoard(grey, board, camera.lens)) out.push_back({stamp, view->corners});
  });
  return out;
}

}  // namespace field_fusion
