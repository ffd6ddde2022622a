#include "camera_imu_start.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "field_fusion/core/base/median.h"

namespace field_fusion::core {
namespace {

constexpr double kSpan = 0.1;      // [s] between pictures that are compared: sooner, noise is most of a turn
constexpr double kLongest = 0.25;  // [s] beyond which a mean rate tells little
constexpr std::size_t kFewest = 20;  // turns between pictures
const double kLeastRate =
    radians(5.0);  // [rad/s] spread of the rates about an axis, some times that of the corners' noise
constexpr double kWorstFit =
    0.5;                          // of the spread of the rates, that may be left between camera and gyroscope
constexpr double kOutlier = 3.0;  // times the median

/// Mean rate of the camera between two pictures, in its own frame.
struct Turn {
  double begin, end;     // [s] of the camera's clock
  Eigen::Vector3d rate;  // [rad/s]
};

std::vector<Turn> turnsOf(const std::vector<CameraPlace>& places) {
  std::vector<Turn> out;
  std::size_t next = 0;
  for (const CameraPlace& place : places) {
    while (next < places.size() && places[next].stamp < place.stamp + kSpan) ++next;
    if (next == places.size()) break;
    const double span = places[next].stamp - place.stamp;
    if (span > kLongest) continue;
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(place.T_board_camera.linear().transpose() * places[next].T_board_camera.linear()));
    out.push_back({place.stamp, places[next].stamp, turn.axis() * turn.angle() / span});
  }
  return out;
}

/// Integral of the rates, so that the mean over any span costs two look-ups.
class RateIntegral {
 public:
  explicit RateIntegral(const std::vector<ImuReading>& readings)
      : readings_(readings), sums_{Eigen::Vector3d::Zero()} {
    for (std::size_t i = 1; i < readings.size(); ++i)
      sums_.push_back(sums_.back() + 0.5 * (readings[i].stamp - readings[i - 1].stamp) *
                                         (readings[i].rate + readings[i - 1].rate));
  }
  bool covers(double begin, double end) const {
    return begin >= readings_.front().stamp && end <= readings_.back().stamp;
  }
  Eigen::Vector3d mean(double begin, double end) const { return (at(end) - at(begin)) / (end - begin); }

 private:
  Eigen::Vector3d at(double time) const {
    const auto after = std::upper_bound(readings_.begin() + 1, readings_.end() - 1, time,
                                        [](double t, const ImuReading& r) { return t < r.stamp; });
    const auto i = static_cast<std::size_t>(after - readings_.begin());
    const double share = (time - readings_[i - 1].stamp) / (readings_[i].stamp - readings_[i - 1].stamp);
    return sums_[i - 1] + share * (sums_[i] - sums_[i - 1]);
  }

  const std::vector<ImuReading>& readings_;
  std::vector<Eigen::Vector3d> sums_;
};

struct RatePair {
  Eigen::Vector3d camera, imu;
};

struct Fit {
  Eigen::Matrix3d R_camera_imu = Eigen::Matrix3d::Identity();
  Eigen::Vector3d camera, imu;  // means
  std::vector<double> left;     // [rad/s] of each pair

  Eigen::Vector3d gyroBias() const { return imu - R_camera_imu.transpose() * camera; }
};

/// Rotation between two sets of rates, their means taken off: a bias does not count (Kabsch 1976).
Fit fitted(const std::vector<RatePair>& pairs) {
  Fit fit;
  fit.camera = fit.imu = Eigen::Vector3d::Zero();
  const double n = static_cast<double>(pairs.size());
  for (const RatePair& pair : pairs) fit.camera += pair.camera / n, fit.imu += pair.imu / n;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const RatePair& pair : pairs)
    products += (pair.camera - fit.camera) * (pair.imu - fit.imu).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double side = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  fit.R_camera_imu = svd.matrixU() * Eigen::Vector3d(1, 1, side).asDiagonal() * svd.matrixV().transpose();
  for (const RatePair& pair : pairs)
    fit.left.push_back((pair.camera - fit.camera - fit.R_camera_imu * (pair.imu - fit.imu)).norm());
  return fit;
}

/// Without the pairs that do not fit: a board that was not where it seemed.
Fit fittedWell(std::vector<RatePair> pairs) {
  Fit fit = fitted(pairs);
  const double limit = kOutlier * median(fit.left);
  std::vector<RatePair> good;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (fit.left[i] <= limit) good.push_back(pairs[i]);
  return fitted(good);
}

std::vector<RatePair> pairsAt(const std::vector<Turn>& turns, const RateIntegral& gyro, double offset) {
  std::vector<RatePair> out;
  for (const Turn& turn : turns)
    if (gyro.covers(turn.begin + offset, turn.end + offset))
      out.push_back({turn.rate, gyro.mean(turn.begin + offset, turn.end + offset)});
  return out;
}

/// Half of the pictures have to be there: few that fit by chance are no fit.
double misfit(const std::vector<Turn>& turns, const RateIntegral& gyro, double offset) {
  const auto pairs = pairsAt(turns, gyro, offset);
  if (pairs.size() < kFewest || 2 * pairs.size() < turns.size())
    return std::numeric_limits<double>::infinity();
  return median(fitted(pairs).left);
}

double bestOffset(const std::vector<Turn>& turns, const RateIntegral& gyro, double limit) {
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  const auto look = [&](double offset) {
    const double value = misfit(turns, gyro, offset);
    if (value < least) least = value, best = offset;
  };
  constexpr double kCoarse = 0.01, kFine = 1e-3;  // [s]
  const int steps = static_cast<int>(limit / kCoarse);
  look(0.0);
  for (int i = -steps; i <= steps; ++i) look(kCoarse * i);
  const double middle = best;
  for (double by = -kCoarse; by <= kCoarse; by += kFine) look(middle + by);
  if (std::isinf(least))
    throw std::runtime_error(
        "the pictures with the board and the readings of the inertial unit are not of one time: fewer than " +
        std::to_string(kFewest) + " turns between pictures lie within the readings");
  return best;
}

/// Says what cannot be known from such turns.
void refuseDull(const std::vector<Turn>& turns) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const double n = static_cast<double>(turns.size());
  for (const Turn& turn : turns) mean += turn.rate / n;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Turn& turn : turns) squares += (turn.rate - mean) * (turn.rate - mean).transpose() / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(squares);
  const Eigen::Array3d spread = eigen.eigenvalues().array().max(0.0).sqrt();
  char text[300];
  if (spread[2] < kLeastRate) {
    std::snprintf(
        text, sizeof text,
        "the camera hardly turns (%.1f deg/s): neither the unit's rotation nor its place can be known",
        degrees(spread[2]));
    throw std::runtime_error(text);
  }
  if (spread[1] < kLeastRate) {
    const Eigen::Vector3d axis = eigen.eigenvectors().col(2);
    std::snprintf(text, sizeof text,
                  "the camera turns about one axis alone, (%.2f, %.2f, %.2f) of its own: the unit's place "
                  "along it stays unknown; "
                  "turn it about a second axis",
                  axis.x(), axis.y(), axis.z());
    throw std::runtime_error(text);
  }
}

void refuseStrange(const Fit& fit, const std::vector<RatePair>& pairs, double limit) {
  double spread = 0, left = 0;
  const double n = static_cast<double>(pairs.size());
  for (const RatePair& pair : pairs) spread += (pair.camera - fit.camera).squaredNorm() / n;
  for (const double value : fit.left) left += value * value / static_cast<double>(fit.left.size());
  if (left < kWorstFit * kWorstFit * spread) return;
  char text[300];
  std::snprintf(text, sizeof text,
                "turns of the camera (%.1f deg/s) and of the gyroscope do not fit, %.1f deg/s are left: "
                "clocks that differ by more "
                "than %.2f s, rates in other units, or camera and unit that are not fixed to one another",
                degrees(std::sqrt(spread)), degrees(std::sqrt(left)), limit);
  throw std::runtime_error(text);
}

Transform turnedBoard() { return Transform(Eigen::AngleAxisd(radians(180.0), Eigen::Vector3d::UnitZ())); }

}  // namespace

std::vector<CameraPlace> cameraPlaces(const Board& board, const CameraLens& lens,
                                      const std::vector<Sighting>& sightings) {
  std::vector<CameraPlace> out;
  for (const Sighting& sighting : sightings) {
    const auto view = locateBoard(sighting.corners, board, lens);
    if (!view) continue;
    CameraPlace place{sighting.stamp, sighting.corners, view->T_camera_board.inverse()};
    if (!out.empty()) {
      const Eigen::Quaterniond last(out.back().T_board_camera.linear());
      const Transform other = turnedBoard() * place.T_board_camera;
      if (last.angularDistance(Eigen::Quaterniond(other.linear())) <
          last.angularDistance(Eigen::Quaterniond(place.T_board_camera.linear()))) {
        place.T_board_camera = other;
        std::reverse(place.corners.begin(), place.corners.end());
      }
    }
    out.push_back(std::move(place));
  }
  return out;
}

CameraImuStart startCameraImu(const std::vector<CameraPlace>& places, const std::vector<ImuReading>& readings,
                              const CameraImuOptions& options) {
  const auto turns = turnsOf(places);
  if (turns.size() < kFewest) {
    char text[250];
    std::snprintf(text, sizeof text,
                  "too few pictures of the board follow one another within %.2f s: %zu turns between them, %zu at least "
                  "are needed (%zu pictures in %.1f s)",
                  kLongest, turns.size(), kFewest, places.size(), places.back().stamp - places.front().stamp);
    throw std::runtime_error(text);
  }
  refuseDull(turns);
  const RateIntegral gyro(readings);
  const double offset = bestOffset(turns, gyro, options.max_offset);
  const auto pairs = pairsAt(turns, gyro, offset);
  const Fit fit = fittedWell(pairs);
  refuseStrange(fit, pairs, options.max_offset);
  return {offset, fit.R_camera_imu, fit.gyroBias()};
}

}  // namespace field_fusion::core
