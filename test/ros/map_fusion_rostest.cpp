// Two maps over topics: a wall that the scanner sees and a low box that the camera sees, and what goes wrong
// on a robot.
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <std_srvs/Empty.h>

#include <sstream>

#include "field_fusion/SaveMap.h"
#include "field_fusion/core/io/map_file.h"
#include "support/frames.h"
#include "support/stage_probe.h"
#include "support/temp_folder.h"

namespace field_fusion::test {
namespace {

class MapFusionStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil(
        [this] { return a_.connected() && b_.connected() && fused_.connected() && local_.connected(); }));
    static double start = 100000.0;
    now_ = start -= 1000.0;  // a time jump, which clears what the test before has left
  }

  /// Four cells along x from the origin.
  nav_msgs::OccupancyGrid grid(const std::vector<std::int8_t>& cells, const std::string& frame = "map") {
    nav_msgs::OccupancyGrid out;
    out.header.frame_id = frame;
    out.header.stamp.fromSec(now_);
    out.info.resolution = 0.05f;
    out.info.width = static_cast<std::uint32_t>(cells.size()), out.info.height = 1;
    out.info.origin.orientation.w = 1.0;
    out.data = cells;
    return out;
  }
  bool came() const { return fused_.last && fused_.last->header.stamp == ros::Time(now_); }
  int cell(int x) const {
    const auto& info = fused_.last->info;
    const int u = x - static_cast<int>(std::lround(info.origin.position.x / info.resolution));
    const int v = -static_cast<int>(std::lround(info.origin.position.y / info.resolution));
    return fused_.last->data.at(static_cast<std::size_t>(v) * info.width + u);
  }
  bool begins(const std::vector<std::int8_t>& cells) {
    return askUntil([this] { return came(); }, [&] { now_ += 0.1, a_.send(grid(cells)); });
  }
  bool sendB(const nav_msgs::OccupancyGrid& map) {
    b_.send(map);
    return spinUntil([this] { return came(); });
  }
  bool says(const std::string& words) {
    return spinUntil([&] { return diagnostics_.says("map_fusion", words); });
  }

  std::string stampText() const {
    std::ostringstream out;
    out << ros::Time(now_);
    return out.str();
  }

  bool counts(const std::string& kind) {
    return spinUntil(
        [&] { return !diagnostics_.value("map_fusion", "projected_map: dropped, " + kind).empty(); });
  }

  double now_ = 0.0;
  Frames frames_;
  Sender<nav_msgs::OccupancyGrid> a_{"map"}, b_{"projected_map"};
  Received<nav_msgs::OccupancyGrid> fused_{"fused_map"}, local_{"fused_local_map"};
  Diagnostics diagnostics_;
};

TEST_F(MapFusionStage, IsOccupiedWhereEitherIs) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  EXPECT_TRUE(says("no map B yet"));
  now_ += 0.1;
  ASSERT_TRUE(sendB(grid({-1, 97, 12, -1})));
  EXPECT_EQ(fused_.last->header.frame_id, "map");
  EXPECT_GE(cell(0), 50);
  EXPECT_GE(cell(1), 50) << "a low box that the scanner sees over";
  EXPECT_LT(cell(2), 50);
  EXPECT_EQ(cell(3), -1);
  for (int i = 0; i < 20; ++i) now_ += 0.1, a_.send(grid({100, 0, 0, -1}));
  ASSERT_TRUE(spinUntil([this] { return came(); }));
  EXPECT_GE(cell(1), 50) << "however often";
}

TEST_F(MapFusionStage, BeforeAnyScanMapBIsAllThereIsAndThatIsSaid) {
  ASSERT_TRUE(askUntil([this] { return came(); }, [this] { now_ += 0.1, b_.send(grid({-1, 97, 12, -1})); }));
  EXPECT_EQ(cell(0), -1);
  EXPECT_GE(cell(1), 50);
  EXPECT_LT(cell(2), 50);
  EXPECT_TRUE(says("no map A yet"));
  now_ += 0.1;
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  EXPECT_GE(cell(0), 50);
  EXPECT_GE(cell(1), 50);
}

TEST_F(MapFusionStage, WithoutTheCameraMapAGoesOnAndThatIsSaid) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  now_ += 0.1;
  ASSERT_TRUE(sendB(grid({-1, 97, -1, -1})));
  EXPECT_TRUE(spinUntil(
      [&] { return diagnostics_.says("map_fusion", "nothing new on projected_map"); },
      [&] { now_ += 0.1, a_.send(grid({100, 0, 100, -1})); }));
  now_ += 0.1;
  ASSERT_TRUE(begins({100, 0, 100, -1}));
  EXPECT_GE(cell(1), 50) << "what the camera told";
  EXPECT_GE(cell(2), 50);
  now_ += 10.0;
  ASSERT_TRUE(sendB(grid({-1, 12, -1, -1}))) << "it is back";
  EXPECT_LT(cell(1), 50);
}

TEST_F(MapFusionStage, ARobotThatStandsMakesNoNewMapAAndNobodyIsAlarmed) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  const auto stands = ros::WallTime::now();
  EXPECT_TRUE(spinUntil(
      [&] {
        return (ros::WallTime::now() - stands).toSec() > 2.5 && diagnostics_.of("map_fusion") &&
               !diagnostics_.says("map_fusion", "nothing new");
      },
      [&] { now_ += 0.1, b_.send(grid({-1, 97, -1, -1})); }));
}

TEST_F(MapFusionStage, MapsOfAnotherFrameOrResolutionAreRefusedAndNothingIsLost) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  now_ += 0.1;
  b_.send(grid({97, 97, 97, 97}, "odom"));
  EXPECT_TRUE(counts("frame differs"));
  now_ += 0.1;
  auto coarse = grid({97, 97, 97, 97});
  coarse.info.resolution = 0.1f;
  b_.send(coarse);
  EXPECT_TRUE(counts("resolution differs"));
  now_ += 0.1;
  auto turned = grid({97, 97, 97, 97});
  turned.info.origin.orientation.z = turned.info.origin.orientation.w = std::sqrt(0.5);
  b_.send(turned);
  EXPECT_TRUE(counts("map turned"));
  now_ += 0.1;
  auto cut = grid({97, 97, 97, 97});
  cut.data.pop_back();
  b_.send(cut);
  EXPECT_TRUE(counts("map damaged"));
  now_ += 0.1;
  ASSERT_TRUE(sendB(grid({-1, -1, 97, -1})));
  EXPECT_GE(cell(0), 50);
  EXPECT_LT(cell(1), 50);
  EXPECT_GE(cell(2), 50);
}

TEST_F(MapFusionStage, MapASaysWhichFrameAndResolutionAreRight) {
  auto coarse = grid({97, 97});
  coarse.info.resolution = 0.1f;
  ASSERT_TRUE(askUntil([this] { return came(); }, [&] { now_ += 0.1, coarse.header.stamp.fromSec(now_), b_.send(coarse); }));
  now_ += 0.1;
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  EXPECT_FLOAT_EQ(fused_.last->info.resolution, 0.05f);
  EXPECT_GE(cell(0), 50);
  EXPECT_LT(cell(1), 50) << "nothing of map B is left";
  now_ += 0.1, coarse.header.stamp.fromSec(now_), b_.send(coarse);
  EXPECT_TRUE(counts("resolution differs"));
}

TEST_F(MapFusionStage, AMapThatIsEmptyOrWithoutAFrameSettlesNothing) {
  auto empty = grid({}, "");
  empty.info.width = empty.info.height = 0;
  a_.send(empty);
  now_ += 0.1, b_.send(grid({97}, ""));
  EXPECT_TRUE(counts("frame missing"));
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  EXPECT_EQ(fused_.last->header.frame_id, "map");
}

TEST_F(MapFusionStage, AStampFromTheFutureStopsNothing) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  auto late = grid({100, 100, 0, -1});
  late.header.stamp = ros::Time::now() + ros::Duration(3600.0);
  a_.send(late);
  EXPECT_TRUE(says("stamp is ahead of the clock: by 3600 s"));
  now_ += 0.1;
  ASSERT_TRUE(sendB(grid({-1, -1, 97, -1})));
  EXPECT_LT(cell(1), 50);
  EXPECT_GE(cell(2), 50);
}

TEST_F(MapFusionStage, AMapFarAwayIsRefused) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  auto far = grid({97, 97, 97, 97});
  far.info.origin.position.x = 500.0;
  now_ += 0.1, far.header.stamp.fromSec(now_), b_.send(far);
  EXPECT_TRUE(counts("map too far"));
  EXPECT_LT(fused_.last->info.width, 1000u);
}

TEST_F(MapFusionStage, WhoComesLateGetsTheMapAsItIs) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  now_ += 0.1;
  ASSERT_TRUE(sendB(grid({-1, 97, -1, -1})));
  fused_.leave(), local_.leave();
  now_ += 0.1, b_.send(grid({-1, -1, 97, -1}));
  ASSERT_TRUE(spinUntil([this] { return diagnostics_.value("map_fusion", "projected_map: last message").find(stampText()) == 0; }));
  Received<nav_msgs::OccupancyGrid> late("fused_map");
  EXPECT_TRUE(spinUntil([&] { return late.last && late.last->header.stamp == ros::Time(now_); }));
}

TEST_F(MapFusionStage, IsSavedAndForgottenWhenAsked) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  now_ += 0.1;
  ASSERT_TRUE(sendB(grid({-1, 97, -1, -1})));
  const TempFolder folder;
  SaveMap save;
  save.request.file = (folder.path() / "fused.yaml").string();
  ASSERT_TRUE(ros::service::call("save_fused_map", save));
  ASSERT_TRUE(save.response.success) << save.response.message;
  const core::Occupancy read = core::readMap(save.request.file);
  const auto at = [&](int x) {
    const auto u = x - std::lround(read.x / 0.05), v = -std::lround(read.y / 0.05);
    return read.cells.at(static_cast<std::size_t>(v * read.width + u));
  };
  EXPECT_GE(at(0), 50);
  EXPECT_GE(at(1), 50);
  EXPECT_LT(at(2), 50);
  std_srvs::Empty reset;
  ASSERT_TRUE(ros::service::call("reset_fused_map", reset));
  ASSERT_TRUE(ros::service::call("save_fused_map", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_EQ(save.response.message, "there is no map yet");
}

TEST_F(MapFusionStage, TheLocalMapIsAboutTheRobot) {
  ASSERT_TRUE(begins({100, 0, 0, -1}));
  ASSERT_TRUE(askUntil([this] { return local_.last && local_.last->header.stamp == ros::Time(now_); },
                       [this] {
                         now_ += 0.1;
                         for (const double stamp : {now_ - 0.05, now_ + 0.05})
                           frames_.send(stamp, "map", "base",
                                        core::Transform(Eigen::Translation3d(3.0, 1.0, 0.0)));
                         a_.send(grid({100, 0, 0, -1}));
                       }));
  EXPECT_NEAR(local_.last->info.origin.position.x, -2.0, 0.03);
  EXPECT_NEAR(local_.last->info.origin.position.y, -4.0, 0.03);
  EXPECT_EQ(local_.last->info.width, 200u);
}

}  // namespace
}  // namespace field_fusion::test
