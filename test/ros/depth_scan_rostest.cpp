// Depth over topics: a camera 15 degrees down on a body that pitches, 3 m before a wall.
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>

#include <cstring>

#include "field_fusion/ros/cloud_message.h"
#include "support/depth_room.h"
#include "support/frames.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

class DepthScanStage : public testing::Test {
 protected:
  void SetUp() override {
    room_.width = 160, room_.height = 120, room_.focal = 100.0;
    room_.T_ground_base.rotate(Eigen::AngleAxisd(core::radians(4.0), Eigen::Vector3d(1, 1, 0).normalized()));
    frames_.sendStatic("base", "camera", room_.T_base_camera);
    ASSERT_TRUE(spinUntil([this] {
      return image_.connected() && info_.connected() && cloud_.connected() && out_.connected() &&
             by_points_.connected();
    }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }

  std_msgs::Header header() const {
    std_msgs::Header out;
    out.frame_id = "camera";
    out.stamp.fromSec(now_);
    return out;
  }
  template <class Pixel>
  sensor_msgs::Image imageOf(const std::vector<Pixel>& pixels, const std::string& encoding) const {
    sensor_msgs::Image out;
    out.header = header();
    out.width = static_cast<std::uint32_t>(room_.width),
    out.height = static_cast<std::uint32_t>(room_.height);
    out.encoding = encoding;
    out.step = out.width * sizeof(Pixel);
    out.data.resize(pixels.size() * sizeof(Pixel));
    std::memcpy(out.data.data(), pixels.data(), out.data.size());
    return out;
  }
  sensor_msgs::Image millimetres() const { return imageOf(room_.pixels<std::uint16_t>(0.001), "16UC1"); }
  /// A new instant, for which pose and calibration are known.
  void next() {
    now_ += 0.1;
    for (const double stamp : {now_ - 0.05, now_ + 0.05})
      frames_.send(stamp, "odom", "base", room_.T_ground_base);
    const core::Pinhole camera{room_.focal, room_.focal, 0.5 * room_.width, 0.5 * room_.height};
    info_.send(cameraInfo(header(), camera, {room_.width, room_.height}));
  }
  template <class Out>
  bool came(const Out& out) const {
    return out.last && out.last->header.stamp == ros::Time(now_);
  }
  bool works() {
    return askUntil([this] { return came(out_) && frames_.knows(now_, "odom", "depth_plane"); },
                    [this] { next(), image_.send(millimetres()); });
  }
  static float ahead(const sensor_msgs::LaserScan& scan) {
    return scan.ranges.at(static_cast<std::size_t>(std::lround(-scan.angle_min / scan.angle_increment)));
  }
  bool counts(const std::string& key) {
    return spinUntil([&] { return !diagnostics_.value("depth_scan", key).empty(); });
  }

  double now_ = 0.0;
  DepthRoom room_;
  Frames frames_;
  Sender<sensor_msgs::Image> image_{"image"};
  Sender<sensor_msgs::CameraInfo> info_{"camera_info"};
  Sender<CloudMessage> cloud_{"points"};
  Received<sensor_msgs::LaserScan> out_{"depth_scan"}, by_points_{"by_points/depth_scan"};
  Diagnostics diagnostics_;
};

TEST_F(DepthScanStage, WallStandsWhereItIsInALevelPlaneOverTheGround) {
  ASSERT_TRUE(works());
  EXPECT_EQ(out_.last->header.frame_id, "depth_plane");
  EXPECT_NEAR(ahead(*out_.last), 3.0, 0.01);
  EXPECT_TRUE(std::isnan(out_.last->ranges[0])) << "nobody looked behind";
  const auto T_odom_plane = frames_.at(now_, "odom", "depth_plane");
  EXPECT_TRUE(T_odom_plane.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-6));
  EXPECT_NEAR(T_odom_plane.translation().z(), 0.1, 1e-6);
}

TEST_F(DepthScanStage, MetresAndPointsSayTheSame) {
  ASSERT_TRUE(works());
  const float want = ahead(*out_.last);
  next();
  image_.send(imageOf(room_.pixels<float>(1.0), "32FC1"));
  ASSERT_TRUE(spinUntil([this] { return came(out_); }));
  EXPECT_NEAR(ahead(*out_.last), want, 1e-3);
  CloudMessage cloud;
  cloud.header = header();
  for (int v = 0; v < room_.height; ++v)
    for (int u = 0; u < room_.width; ++u) {
      const auto z = static_cast<float>(room_.depth(u, v));
      core::Point p;
      p.x = static_cast<float>((u - 0.5 * room_.width) / room_.focal) * z;
      p.y = static_cast<float>((v - 0.5 * room_.height) / room_.focal) * z;
      p.z = z > 0.f ? z : core::kNaN;
      cloud.points.push_back(p);
    }
  cloud_.send(cloud);
  ASSERT_TRUE(spinUntil([this] { return came(by_points_); }));
  EXPECT_EQ(by_points_.last->header.frame_id, "points_plane");
  EXPECT_NEAR(ahead(*by_points_.last), want, 1e-3);
}

TEST_F(DepthScanStage, ImageOfZerosIsNotFree) {
  ASSERT_TRUE(works());
  next();
  image_.send(imageOf(std::vector<std::uint16_t>(160 * 120, 0), "16UC1"));
  ASSERT_TRUE(spinUntil([this] { return came(out_); }));
  for (const float range : out_.last->ranges) EXPECT_TRUE(std::isnan(range));
  EXPECT_TRUE(spinUntil([this] {
    return diagnostics_.says("depth_scan", "the last depth has no point at all") &&
           diagnostics_.of("depth_scan")->level == diagnostic_msgs::DiagnosticStatus::WARN;
  }));
}

TEST_F(DepthScanStage, DamagedAndUnknownImagesAreDroppedAndNamed) {
  ASSERT_TRUE(works());
  next();
  auto damaged = millimetres();
  damaged.data.resize(100);
  image_.send(damaged);
  EXPECT_TRUE(counts("image: dropped, image damaged"));
  next();
  auto coloured = millimetres();
  coloured.encoding = "rgb8";
  image_.send(coloured);
  EXPECT_TRUE(counts("image: dropped, image encoding not known"));
  EXPECT_TRUE(works());
}

TEST_F(DepthScanStage, WithoutPoseOfTheBodyItIsDroppedAndNamed) {
  ASSERT_TRUE(works());
  now_ += 50.0;
  const core::Pinhole camera{100.0, 100.0, 80.0, 60.0};
  info_.send(cameraInfo(header(), camera, {room_.width, room_.height}));
  image_.send(millimetres());
  EXPECT_TRUE(counts("image: dropped, no transform"));
  EXPECT_TRUE(works());
}

}  // namespace
}  // namespace field_fusion::test
