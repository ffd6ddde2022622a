#include "field_fusion/core/calib/camera_imu.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "camera_imu_problem.h"
#include "field_fusion/core/base/median.h"

namespace field_fusion::core {
namespace {

constexpr double kShortest = 5.0;  // [s] of pictures with readings
constexpr double kGap = 5.5;       // intervals between two readings
constexpr std::size_t kFewestReadings = 10;
const double kUnsureTurn = radians(1.0);
constexpr double kUnsureShift = 0.03, kUnsureTime = 0.005;  // [m], [s]
constexpr double kWorstForce =
    1.0;  // [m/s^2] of noise: more is a board of another size, or a unit that counts in g

void require(bool holds, const std::string& reason) {
  if (!holds) throw std::invalid_argument(reason);
}

std::string at(double stamp) {
  char text[40];
  std::snprintf(text, sizeof text, "stamp %.3f: ", stamp);
  return text;
}

void check(const Board& board, const std::vector<Sighting>& sightings,
           const std::vector<ImuReading>& readings, const CameraImuOptions& options) {
  require(options.gyro_walk > 0 && options.accel_walk > 0 && options.max_offset >= 0 && options.knots > 0,
          "random walks and knots must be above 0, the largest offset not below");
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Sighting& s = sightings[i];
    require(std::isfinite(s.stamp), "a stamp of a picture is not finite");
    require(i == 0 || s.stamp > sightings[i - 1].stamp,
            at(s.stamp) + "a picture does not come after the one before");
    require(s.corners.size() == board.corners().size(),
            at(s.stamp) + "a picture has " + std::to_string(s.corners.size()) + " corners, the board has " +
                std::to_string(board.corners().size()));
    for (const Eigen::Vector2d& corner : s.corners)
      require(corner.allFinite(), at(s.stamp) + "a corner is not finite");
  }
  checkReadings(readings);
}

/// Over a gap the spline would follow nothing.
void refuseGaps(const std::vector<ImuReading>& readings, double begin, double end) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < readings.size(); ++i)
    steps.push_back(readings[i].stamp - readings[i - 1].stamp);
  const double interval = median(steps);
  for (std::size_t i = 1; i < readings.size(); ++i)
    if (readings[i].stamp > begin && readings[i - 1].stamp < end && steps[i - 1] > kGap * interval)
      throw std::runtime_error(at(readings[i - 1].stamp) + "a gap of " + std::to_string(steps[i - 1]) +
                               " s in the readings of the inertial unit");
}

void refuseUnsure(const CameraImuCalibration& found) {
  char text[300];
  if (found.accel_sigma > kWorstForce) {
    std::snprintf(text, sizeof text,
                  "the accelerometer does not fit the camera's way, %.1f m/s^2 are left: squares of another "
                  "size than --board says, "
                  "or forces in other units",
                  found.accel_sigma);
    throw std::runtime_error(text);
  }
  if (found.rotationSigma() < kUnsureTurn && found.translationSigma() < kUnsureShift &&
      found.offsetSigma() < kUnsureTime)
    return;
  std::snprintf(text, sizeof text,
                "the motion tells too little: standard deviations of %.2f deg, %.3f m and %.1f ms are left; "
                "turn faster, about all "
                "axes",
                degrees(found.rotationSigma()), found.translationSigma(), 1e3 * found.offsetSigma());
  throw std::runtime_error(text);
}

}  // namespace

double CameraImuCalibration::rotationSigma() const {
  return std::sqrt(covariance.diagonal().head<3>().sum());
}
double CameraImuCalibration::translationSigma() const {
  return std::sqrt(covariance.diagonal().segment<3>(3).sum());
}
double CameraImuCalibration::offsetSigma() const { return std::sqrt(covariance(6, 6)); }

void checkReadings(const std::vector<ImuReading>& readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const ImuReading& r = readings[i];
    require(std::isfinite(r.stamp), "a stamp of the inertial unit is not finite");
    require(i == 0 || r.stamp > readings[i - 1].stamp,
            at(r.stamp) + "a reading does not come after the one before");
    require(r.rate.allFinite() && r.force.allFinite(),
            at(r.stamp) + "a reading of the inertial unit is not finite");
  }
}

CameraImuCalibration calibrateCameraImu(const Board& board, const CameraLens& lens,
                                        const std::vector<Sighting>& sightings,
                                        const std::vector<ImuReading>& readings,
                                        const CameraImuOptions& options) {
  check(board, sightings, readings, options);
  const auto places = cameraPlaces(board, lens, sightings);
  if (places.empty()) throw std::runtime_error("no picture shows the board");
  if (readings.size() < kFewestReadings)
    throw std::runtime_error(std::to_string(readings.size()) + " readings of the inertial unit");
  const double begin = std::max(places.front().stamp, readings.front().stamp),
               end = std::min(places.back().stamp, readings.back().stamp);
  if (end - begin < kShortest) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "too short: pictures of the board and readings of the inertial unit overlap for %.1f s of %.0f",
        std::max(0.0, end - begin), kShortest);
    throw std::runtime_error(text);
  }
  refuseGaps(readings, begin, end);
  const CameraImuStart start = startCameraImu(places, readings, options);
  CameraImuProblem problem(board, lens, places, readings, start, options);
  problem.solve();
  const CameraImuCalibration found = problem.result();
  refuseUnsure(found);
  return found;
}

}  // namespace field_fusion::core
