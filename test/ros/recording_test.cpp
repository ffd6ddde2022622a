#include "field_fusion/ros/recording.h"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sys/resource.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <csignal>
#include <iterator>
#include <random>
#include <set>

#include "field_fusion/ros/cloud_message.h"
#include "support/temp_folder.h"

namespace field_fusion {
namespace {

CloudMessage cloudAt(double stamp) {
  CloudMessage cloud;
  cloud.header.stamp = ros::Time(stamp);
  cloud.points.resize(3);
  return cloud;
}

TEST(Recording, HasItsNameOnlyWhenFinished) {
  const test::TempFolder folder;
  const auto file = folder.path() / "a.bag";
  Recording recording(file.string());
  recording.write("/points", cloudAt(5.0));
  EXPECT_FALSE(std::filesystem::exists(file));
  recording.finish();
  EXPECT_EQ(rosbag::View(rosbag::Bag(file.string())).getBeginTime(), ros::Time(5.0));
}

TEST(Recording, LeavesNothingWhenItIsNotFinished) {
  const test::TempFolder folder;
  {
    Recording recording((folder.path() / "a.bag").string());
    recording.write("/points", cloudAt(5.0));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Recording, TwoOfOneNameDoNotMixAndTheLastToFinishStays) {
  const test::TempFolder folder;
  const auto file = folder.path() / "a.bag";
  Recording first(file.string()), second(file.string());
  for (int i = 0; i < 3; ++i) {
    first.write("/first", cloudAt(5.0 + i));
    second.write("/second", cloudAt(8.0 + i));
  }
  const auto contents = [&file] {
    std::set<std::string> topics;
    const rosbag::Bag bag(file.string());
    rosbag::View view(bag);
    for (const auto& message : view) topics.insert(message.getTopic());
    return std::pair(topics, view.size());
  };
  first.finish();
  EXPECT_EQ(contents(), std::pair(std::set<std::string>{"/first"}, 3u));
  second.finish();
  EXPECT_EQ(contents(), std::pair(std::set<std::string>{"/second"}, 3u));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Recording, LeavesAnotherOnesPartAlone) {
  const test::TempFolder folder;
  const auto other = folder.write("a.bag.part", "of another");
  Recording((folder.path() / "a.bag").string()).write("/points", cloudAt(5.0));
  std::ifstream in(other);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "of another");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Recording, RefusesAFileThatCannotBeWritten) {
  EXPECT_THROW(Recording("/nowhere/a.bag"), rosbag::BagException);
}

TEST(Recording, RefusesANameThatIsNoPlainFiles) {
  const test::TempFolder folder;
  EXPECT_THROW(Recording(folder.path().string()), std::runtime_error);
  EXPECT_THROW(Recording("/dev/null"), std::runtime_error);
  EXPECT_THROW(Recording(""), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// No file grows beyond `bytes` while this lives, as on a full disk.
struct FullDisk {
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit less{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
  rlimit before;
  void (*handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

TEST(Recording, LeavesNothingOnAFullDisk) {
  const test::TempFolder folder;
  CloudMessage noise = cloudAt(5.0);
  noise.points.resize(50000);
  std::mt19937 draw(1);  // what does not shrink
  std::uniform_real_distribution<float> metres(-50.f, 50.f);
  for (auto& point : noise.points) point.x = metres(draw), point.y = metres(draw), point.z = metres(draw);
  const auto fill = [&] {
    Recording recording((folder.path() / "a.bag").string());
    for (int i = 0; i < 20; ++i) recording.write("/points", noise);
    recording.finish();
  };
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{1} << 20}) {
    const FullDisk full(bytes);
    EXPECT_THROW(fill(), rosbag::BagException);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << bytes;
  }
}

TEST(Recording, LatchesStaticTransforms) {
  const test::TempFolder folder;
  const std::string file = (folder.path() / "a.bag").string();
  core::Transform T_a_b(Eigen::Translation3d(1, 2, 3));
  T_a_b.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  Recording recording(file);
  recording.writeStatic({transformMessage(ros::Time(7.0), "a", "b", T_a_b)});
  recording.finish();

  const rosbag::Bag bag(file);
  rosbag::View view(bag);
  ASSERT_EQ(view.size(), 1u);
  const auto message = view.begin()->instantiate<tf2_msgs::TFMessage>();
  ASSERT_TRUE(message);
  EXPECT_EQ(view.begin()->getTopic(), "/tf_static");
  EXPECT_TRUE(view.begin()->isLatching());
  EXPECT_EQ(message->transforms[0].child_frame_id, "b");
  EXPECT_EQ(message->transforms[0].header.stamp, ros::Time(7.0));
  EXPECT_TRUE(tf2::transformToEigen(message->transforms[0]).isApprox(T_a_b, 1e-12));
}

TEST(CameraInfo, DescribesACameraWithoutDistortion) {
  const auto info = cameraInfo(std_msgs::Header(), {700, 710, 320, 240}, {640, 480});
  EXPECT_EQ(info.width, 640u);
  EXPECT_EQ(info.height, 480u);
  EXPECT_EQ(info.K, (sensor_msgs::CameraInfo::_K_type{700, 0, 320, 0, 710, 240, 0, 0, 1}));
  EXPECT_EQ(info.P, (sensor_msgs::CameraInfo::_P_type{700, 0, 320, 0, 0, 710, 240, 0, 0, 0, 1, 0}));
  EXPECT_EQ(info.D, std::vector<double>(5, 0.0));
}

}  // namespace
}  // namespace field_fusion
