#include "field_fusion/core/calib/camera_imu.h"

#include <gmock/gmock.h>

#include "field_fusion/core/calib/board_draws.h"
#include "field_fusion/core/calib/chart.h"
#include "field_fusion/core/calib/motion_draws.h"

namespace field_fusion::core {
namespace {

using testing::HasSubstr;

const Board kBoard{8, 6, 0.05};
const CameraLens kLens = usualLens();

MotionParams brief() {
  MotionParams params;
  params.seconds = 8.0, params.picture_rate = 10.0;
  return params;
}

DrawnMotion drawn(const MotionParams& params, unsigned seed) {
  std::mt19937 random(seed);
  return drawMotion(kBoard, kLens, params, random);
}

Eigen::Matrix<double, 7, 1> off(const CameraImuCalibration& found, const DrawnMotion& truth,
                                double time_offset) {
  Eigen::Matrix<double, 7, 1> out;
  out << chartOf(found.T_camera_imu, truth.T_camera_imu), time_offset - found.time_offset;
  return out;
}

std::string refusal(const std::vector<Sighting>& sightings, const std::vector<ImuReading>& readings) {
  try {
    calibrateCameraImu(kBoard, kLens, sightings, readings, {});
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(CameraImu, TruthComesBackWithoutNoise) {
  MotionParams params = brief();
  params.pixel_noise = params.gyro_noise = params.accel_noise = params.gyro_walk = params.accel_walk = 0.0;
  params.time_offset = 0.0123;
  const DrawnMotion motion = drawn(params, 1);
  const auto found = calibrateCameraImu(kBoard, kLens, motion.sightings, motion.readings, {});
  const auto error = off(found, motion, params.time_offset);
  EXPECT_LT(error.head<3>().norm(), radians(0.002));
  EXPECT_LT(error.segment<3>(3).norm(), 2e-5);
  EXPECT_LT(std::abs(error[6]), 1e-5);
  EXPECT_NEAR(found.gravity.norm(), 9.80665, 1e-9);
}

TEST(CameraImu, CovarianceHoldsInTheShareOfRunsThatItStates) {
  constexpr double kChi95 = 14.067;  // 95 % of chi-square with 7 degrees of freedom
  constexpr int kRuns = 20;
  int inside = 0;
  for (unsigned run = 0; run < kRuns; ++run) {
    const DrawnMotion motion = drawn(brief(), 100 + run);
    CameraImuOptions options;
    options.gyro_walk = brief().gyro_walk, options.accel_walk = brief().accel_walk;
    options.knots = 25.0;  // enough for motions below 1.5 Hz, and half the time
    const auto found = calibrateCameraImu(kBoard, kLens, motion.sightings, motion.readings, options);
    const auto error = off(found, motion, 0.0);
    inside += error.dot(found.covariance.ldlt().solve(error)) <= kChi95;
  }
  EXPECT_GE(inside, 15);  // fewer has a chance below 0.001 where 95 % are right
}

TEST(CameraImu, NoiseIsFoundAsItWasDrawn) {
  const DrawnMotion motion = drawn(brief(), 3);
  const auto found = calibrateCameraImu(kBoard, kLens, motion.sightings, motion.readings, {});
  EXPECT_NEAR(found.pixel_sigma, brief().pixel_noise, 0.05 * brief().pixel_noise);
  EXPECT_NEAR(found.gyro_sigma, brief().gyro_noise, 0.1 * brief().gyro_noise);
  EXPECT_NEAR(found.accel_sigma, brief().accel_noise, 0.1 * brief().accel_noise);
}

TEST(CameraImu, ClocksThatDifferByATenthOfASecondAreBroughtTogether) {
  for (const double offset : {-0.13, 0.4}) {
    MotionParams params = brief();
    params.time_offset = offset;
    const DrawnMotion motion = drawn(params, 4);
    const auto found = calibrateCameraImu(kBoard, kLens, motion.sightings, motion.readings, {});
    EXPECT_LT(std::abs(off(found, motion, offset)[6]), 5 * found.offsetSigma());
  }
}

TEST(CameraImu, ABoardOutOfViewForTwoSecondsAndCornersFromTheOtherEndDoNoHarm) {
  DrawnMotion motion = drawn(brief(), 5);
  auto& sightings = motion.sightings;
  sightings.erase(sightings.begin() + 30, sightings.begin() + 50);
  for (std::size_t i = 0; i < sightings.size(); i += 7)
    std::reverse(sightings[i].corners.begin(), sightings[i].corners.end());
  const auto found = calibrateCameraImu(kBoard, kLens, sightings, motion.readings, {});
  const auto error = off(found, motion, 0.0);
  constexpr double kChi999 = 24.322;  // 99.9 % of chi-square with 7 degrees of freedom
  EXPECT_LT(error.dot(found.covariance.ldlt().solve(error)), kChi999);
}

TEST(CameraImu, AMotionThatTellsTooLittleIsRefusedWithTheReason) {
  MotionParams still = brief();
  still.turn = 0.0;
  DrawnMotion motion = drawn(still, 6);
  EXPECT_THAT(refusal(motion.sightings, motion.readings), HasSubstr("the camera hardly turns"));
  MotionParams nodding = brief();
  nodding.turns = {1, 0, 0};
  motion = drawn(nodding, 6);
  EXPECT_THAT(refusal(motion.sightings, motion.readings), HasSubstr("turns about one axis alone"));
}

TEST(CameraImu, NoneTooFewAndTooShortAreRefused) {
  const DrawnMotion motion = drawn(brief(), 7);
  EXPECT_THAT(refusal({}, motion.readings), HasSubstr("no picture shows the board"));
  EXPECT_THAT(refusal(motion.sightings, {}), HasSubstr("0 readings of the inertial unit"));
  EXPECT_THAT(refusal({motion.sightings[0]}, motion.readings), HasSubstr("too short"));
  auto half = motion.sightings;
  half.resize(half.size() / 2);
  EXPECT_THAT(refusal(half, motion.readings), HasSubstr("too short"));
  std::vector<Sighting> sparse;
  for (std::size_t i = 0; i < motion.sightings.size(); ++i)
    if (sparse.empty() || motion.sightings[i].stamp >= sparse.back().stamp + 0.3) sparse.push_back(motion.sightings[i]);
  EXPECT_THAT(refusal(sparse, motion.readings), HasSubstr("follow one another within 0.25 s: 0 turns"));
  auto elsewhere = motion.sightings;
  for (Sighting& sighting : elsewhere) sighting.stamp += 1000.0;
  EXPECT_THAT(refusal(elsewhere, motion.readings), HasSubstr("overlap for 0.0 s"));
}

TEST(CameraImu, AGapInTheReadingsIsNamed) {
  DrawnMotion motion = drawn(brief(), 8);
  motion.readings.erase(motion.readings.begin() + 800, motion.readings.begin() + 810);
  EXPECT_THAT(refusal(motion.sightings, motion.readings), HasSubstr("stamp 103.995: a gap of 0.055"));
}

TEST(CameraImu, WhatIsNotFiniteOrNotInOrderIsRefusedByItsStamp) {
  const DrawnMotion motion = drawn(brief(), 9);
  auto readings = motion.readings;
  readings[200].force.y() = kNaN;
  EXPECT_THAT(refusal(motion.sightings, readings),
              HasSubstr("stamp 101.000: a reading of the inertial unit is not finite"));
  readings = motion.readings;
  readings[200].stamp = readings[199].stamp;
  EXPECT_THAT(refusal(motion.sightings, readings), HasSubstr("stamp 100.995: a reading does not come after"));
  auto sightings = motion.sightings;
  sightings[5].corners[3].x() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(sightings, motion.readings), HasSubstr("a corner is not finite"));
  sightings = motion.sightings;
  sightings[5].corners.pop_back();
  EXPECT_THAT(refusal(sightings, motion.readings), HasSubstr("47 corners, the board has 48"));
  sightings = motion.sightings;
  std::swap(sightings[5], sightings[6]);
  EXPECT_THAT(refusal(sightings, motion.readings), HasSubstr("a picture does not come after"));
}

TEST(CameraImu, RatesAndForcesInOtherUnitsAreRefused) {
  const DrawnMotion motion = drawn(brief(), 10);
  auto readings = motion.readings;
  for (ImuReading& reading : readings) reading.rate *= 57.3;
  EXPECT_THAT(refusal(motion.sightings, readings), HasSubstr("turns of the camera"));
  readings = motion.readings;
  for (ImuReading& reading : readings) reading.force /= 9.81;
  EXPECT_THAT(refusal(motion.sightings, readings), HasSubstr("the accelerometer does not fit"));
}

}  // namespace
}  // namespace field_fusion::core
