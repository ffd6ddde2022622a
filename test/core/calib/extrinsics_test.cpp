#include "field_fusion/core/calib/extrinsics.h"

#include <gmock/gmock.h>

#include "field_fusion/core/calib/board_draws.h"
#include "field_fusion/core/calib/chart.h"

namespace field_fusion::core {
namespace {

using testing::HasSubstr;

const Board kBoard{8, 6, 0.1};
const CameraLens kLens = usualLens();

DrawParams noiseFree(bool flat) {
  DrawParams params;
  params.flat = flat;
  params.pixel_noise = params.range_noise = 0.0;
  return params;
}

/// What a user knows: the place by a ruler.
Transform byRuler(const Transform& T_camera_lidar) {
  return T_camera_lidar * motion({0.03, -0.04, 0.02, 0.03, 0.02, -0.03});
}

std::string refusal(const std::vector<CalibrationPose>& poses, const Transform& start,
                    const CalibrationOptions& options = {}) {
  try {
    calibrate(kBoard, kLens, poses, start, options);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

class Sensors : public testing::TestWithParam<bool> {};  // flat

TEST_P(Sensors, TruthComesBackWithoutNoise) {
  std::mt19937 random(1);
  const DrawnBoards drawn = drawBoards(kBoard, kLens, noiseFree(GetParam()), random);
  const Calibration found = calibrate(kBoard, kLens, drawn.poses, byRuler(drawn.T_camera_lidar), {});
  EXPECT_LT(chartOf(drawn.T_camera_lidar, found.T_camera_lidar).norm(), 1e-6);
  EXPECT_EQ(found.poses.size(), 30u);
  for (const PoseResidual& pose : found.poses) {
    EXPECT_TRUE(pose.used);
    EXPECT_LT(pose.rms, 1e-6);
    EXPECT_LT(pose.reprojection, 1e-4);
  }
}

TEST_P(Sensors, TruthComesBackFromAnywhereWithoutNoise) {
  std::mt19937 random(2);
  const DrawnBoards drawn = drawBoards(kBoard, kLens, noiseFree(GetParam()), random);
  const Calibration found = calibrateFromAnywhere(kBoard, kLens, drawn.poses, {});
  EXPECT_LT(chartOf(drawn.T_camera_lidar, found.T_camera_lidar).norm(), 1e-6);
}

TEST_P(Sensors, OffsetAndScaleOfTheRangesAreFoundAlong) {
  std::mt19937 random(3);
  DrawParams params = noiseFree(GetParam());
  params.range_bias = 0.02, params.range_scale = 0.004;
  const DrawnBoards drawn = drawBoards(kBoard, kLens, params, random);
  CalibrationOptions options;
  options.offset_sigma = 1.0, options.scale_sigma = 1.0;  // nearly no prior: the data decide
  const Calibration found = calibrate(kBoard, kLens, drawn.poses, drawn.T_camera_lidar, options);
  EXPECT_LT(chartOf(drawn.T_camera_lidar, found.T_camera_lidar).norm(), 1e-5);
  const Calibration blind = calibrate(kBoard, kLens, drawn.poses, drawn.T_camera_lidar, {});
  EXPECT_GT(chartOf(drawn.T_camera_lidar, blind.T_camera_lidar).norm(), 1e-3);
}

TEST_P(Sensors, CovarianceHoldsInTheShareOfRunsThatItStates) {
  constexpr double kChi95 = 12.592;  // 95 % of chi-square with 6 degrees of freedom
  constexpr int kRuns = 40;
  CalibrationOptions options;
  options.offset_sigma = 0.015 / std::sqrt(3.0), options.scale_sigma = 0.004 / std::sqrt(3.0);
  int inside = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937 random(static_cast<unsigned>(100 + run));
    DrawParams params;
    params.flat = GetParam(), params.poses = 12;
    params.range_bias = 0.015, params.range_scale = 0.004;
    const DrawnBoards drawn = drawBoards(kBoard, kLens, params, random);
    const Calibration found = calibrate(kBoard, kLens, drawn.poses, byRuler(drawn.T_camera_lidar), options);
    const auto off = chartOf(found.T_camera_lidar, drawn.T_camera_lidar);
    inside += off.dot(found.covariance.ldlt().solve(off)) <= kChi95;
  }
  EXPECT_GE(inside, 33);  // fewer has a chance below 0.001 where 95 % are right
}

TEST_P(Sensors, AnOutlierIsNamedAndDoesNotCount) {
  std::mt19937 random(4);
  DrawParams params;
  params.flat = GetParam();
  const DrawnBoards drawn = drawBoards(kBoard, kLens, params, random);
  auto poses = drawn.poses;
  for (BoardReturn& from : poses[7].returns) from.position *= 1.05;  // the board was moved in between
  const Calibration found = calibrate(kBoard, kLens, poses, byRuler(drawn.T_camera_lidar), {});
  for (const PoseResidual& pose : found.poses) EXPECT_EQ(pose.used, pose.name != "pose 8") << pose.name;
  const auto off = chartOf(found.T_camera_lidar, drawn.T_camera_lidar);
  constexpr double kChi999 = 22.458;  // 99.9 % of chi-square with 6 degrees of freedom
  EXPECT_LT(off.dot(found.covariance.ldlt().solve(off)), kChi999);
}

TEST_P(Sensors, AWrongSizeOfTheSquaresShowsInTheRanges) {
  std::mt19937 random(9);
  DrawParams params;
  params.flat = GetParam();
  const DrawnBoards drawn = drawBoards(kBoard, kLens, params, random);
  for (const double stated : {0.1, 0.097}) {
    const Board board{8, 6, stated};
    auto poses = drawn.poses;
    for (CalibrationPose& pose : poses) pose.view.T_camera_board.translation() *= stated / kBoard.square;
    const Calibration found = calibrate(board, kLens, poses, drawn.T_camera_lidar, {});
    const RangeFactor ranges = rangeFactor(board, kLens, poses, found, {});
    EXPECT_NEAR(ranges.factor, kBoard.square / stated, 4.0 * ranges.sigma) << stated;
    EXPECT_LT(ranges.sigma, 0.003);
  }
}

TEST_P(Sensors, ParallelBoardsAreRefusedWithTheReason) {
  std::mt19937 random(5);
  DrawParams params;
  params.flat = GetParam(), params.tilt = 0.0;
  const DrawnBoards drawn = drawBoards(kBoard, kLens, params, random);
  EXPECT_THAT(refusal(drawn.poses, drawn.T_camera_lidar), HasSubstr("all boards are parallel"));
}

INSTANTIATE_TEST_SUITE_P(Both, Sensors, testing::Bool(), [](const auto& info) {
  return info.param ? "flat" : "cloud";
});

TEST(Extrinsics, NoneOneAndTwoPosesAreRefused) {
  std::mt19937 random(6);
  auto poses = drawBoards(kBoard, kLens, {}, random).poses;
  poses.resize(2);
  EXPECT_THAT(refusal(poses, Transform::Identity()), HasSubstr("2 poses of the board; three at least"));
  poses.resize(1);
  EXPECT_THAT(refusal(poses, Transform::Identity()), HasSubstr("1 pose of the board; three at least"));
  EXPECT_THAT(refusal({}, Transform::Identity()), HasSubstr("0 poses of the board; three at least"));
}

TEST(Extrinsics, BoardsTurnedAboutOneAxisAreRefusedWithTheAxis) {
  std::mt19937 random(7);
  DrawnBoards drawn = drawBoards(kBoard, kLens, noiseFree(false), random);
  double angle = -0.5;
  for (CalibrationPose& pose : drawn.poses)
    pose.view.T_camera_board.linear() =
        Eigen::AngleAxisd(angle += 0.03, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_THAT(refusal(drawn.poses, drawn.T_camera_lidar), HasSubstr("turned about one axis"));
}

TEST(Extrinsics, ALineScannedThroughOnePointOfAllBoardsIsRefused) {
  // three boards through the LiDAR's origin: whatever the turn, distances scale with nothing
  std::vector<CalibrationPose> poses(3);
  for (int i = 0; i < 3; ++i) {
    CalibrationPose& pose = poses[static_cast<std::size_t>(i)];
    pose.name = "pose";
    pose.view.T_camera_board = Transform::Identity();
    pose.view.T_camera_board.linear() =
        (Eigen::AngleAxisd(0.4 * i, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.3 * i * i, Eigen::Vector3d::UnitY()))
            .toRotationMatrix();
    pose.view.corners.assign(kBoard.corners().size(), {100.0, 100.0});
    pose.returns.assign(20, {{2.0, 0.0, 0.0}, 0, 1});
  }
  EXPECT_THAT(refusal(poses, Transform::Identity()), HasSubstr("leave a motion of the LiDAR unknown"));
}

TEST(Extrinsics, WhatIsNotFiniteIsRefusedByName) {
  std::mt19937 random(8);
  const DrawnBoards drawn = drawBoards(kBoard, kLens, {}, random);
  auto poses = drawn.poses;
  poses[3].returns[0].position.x() = kNaN;
  EXPECT_THAT(refusal(poses, drawn.T_camera_lidar), HasSubstr("pose 4: a return is not finite"));
  poses = drawn.poses;
  poses[2].view.corners[5].y() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(poses, drawn.T_camera_lidar), HasSubstr("pose 3: a corner is not finite"));
  poses = drawn.poses;
  poses[1].returns.clear();
  EXPECT_THAT(refusal(poses, drawn.T_camera_lidar), HasSubstr("pose 2 has no returns"));
  poses = drawn.poses;
  poses[0].view.corners.pop_back();
  EXPECT_THAT(refusal(poses, drawn.T_camera_lidar), HasSubstr("pose 1 has 47 corners, the board has 48"));
  Transform nowhere = drawn.T_camera_lidar;
  nowhere.translation().z() = kNaN;
  EXPECT_THAT(refusal(drawn.poses, nowhere), HasSubstr("to start from is not finite"));
}

}  // namespace
}  // namespace field_fusion::core
