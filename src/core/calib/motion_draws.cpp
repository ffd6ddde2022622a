#include "field_fusion/core/calib/motion_draws.h"

#include <cmath>

namespace field_fusion::core {
namespace {

constexpr int kWaves = 3;
constexpr double kFirst = 100.0;  // [s] stamp of the beginning
constexpr double kGravity = 9.80665;
const Eigen::Vector2d kPicture(720, 540);

/// A sum of oscillations, and its second derivative.
struct Waves {
  double amplitude[kWaves], omega[kWaves], phase[kWaves];

  double value(double t) const {
    double sum = 0;
    for (int i = 0; i < kWaves; ++i) sum += amplitude[i] * std::sin(omega[i] * t + phase[i]);
    return sum;
  }
  double second(double t) const {
    double sum = 0;
    for (int i = 0; i < kWaves; ++i)
      sum -= amplitude[i] * omega[i] * omega[i] * std::sin(omega[i] * t + phase[i]);
    return sum;
  }
};

class Draw {
 public:
  Draw(const Board& board, const CameraLens& lens, const MotionParams& params, std::mt19937& random)
      : board_(board), lens_(lens), params_(params), random_(random) {}

  DrawnMotion run() {
    DrawnMotion out;
    Eigen::Matrix3d optical;  // of a unit with x ahead, y left, z up
    optical << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    out.T_camera_imu = Transform(optical * turned({even(0.3), even(0.3), even(0.3)}));
    out.T_camera_imu.translation() = Eigen::Vector3d{even(0.1), even(0.1), even(0.1)};
    T_camera_imu_ = out.T_camera_imu;
    up_ = turned({even(0.3), 0.0, even(0.3)}) * -Eigen::Vector3d::UnitY();
    for (int axis = 0; axis < 3; ++axis)
      turns_[axis] = waves(params_.turn * params_.turns[axis]), shifts_[axis] = waves(params_.shift);
    const double tiny = 0.5 / params_.reading_rate;  // the clocks tick at no instants of one another
    for (double t = tiny; t < params_.seconds; t += 1.0 / params_.picture_rate) look(t, out.sightings);
    feel(out.readings);
    return out;
  }

 private:
  double even(double limit) { return std::uniform_real_distribution<>(-limit, limit)(random_); }
  Eigen::Vector3d normal(double sigma) {
    std::normal_distribution<> draw;
    const double x = draw(random_), y = draw(random_), z = draw(random_);
    return sigma * Eigen::Vector3d(x, y, z);
  }
  Waves waves(double amplitude) {
    Waves out;
    for (int i = 0; i < kWaves; ++i) {
      out.amplitude[i] = amplitude / (i + 1.0);
      out.omega[i] = radians(360.0) * (0.3 + 0.45 * i + 0.2 * std::abs(even(1.0)));
      out.phase[i] = even(radians(180.0));
    }
    return out;
  }
  static Eigen::Matrix3d turned(const Eigen::Vector3d& angles) {
    return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }

  Eigen::Matrix3d cameraTurn(double t) const {
    return turned({turns_[0].value(t), turns_[1].value(t), turns_[2].value(t)});
  }
  /// T_board_imu: the unit's place swings about one from which the camera has the board before it.
  Transform place(double t) const {
    Transform T(cameraTurn(t) * T_camera_imu_.linear());
    T.translation() = T_camera_imu_.translation() +
                      Eigen::Vector3d(shifts_[0].value(t), shifts_[1].value(t), shifts_[2].value(t) - 1.1);
    return T;
  }

  void look(double t, std::vector<Sighting>& out) {
    const Transform T_camera_board = T_camera_imu_ * place(t).inverse();
    Sighting sighting{kFirst + t, {}};
    for (const Eigen::Vector3d& corner : board_.corners()) {
      const Eigen::Vector3d p = T_camera_board * corner;
      const Eigen::Vector2d pixel = lens_.project<double>(p) + normal(params_.pixel_noise).head<2>();
      if (!(p.z() > 0.1 && pixel.minCoeff() > 0 && (kPicture - pixel).minCoeff() > 0)) return;
      sighting.corners.push_back(pixel);
    }
    out.push_back(std::move(sighting));
  }

  void feel(std::vector<ImuReading>& out) {
    const double period = 1.0 / params_.reading_rate;
    Eigen::Vector3d gyro_bias{even(1), even(1), even(1)}, accel_bias{even(1), even(1), even(1)};
    gyro_bias *= params_.gyro_bias, accel_bias *= params_.accel_bias;
    for (double t = 0.0; t < params_.seconds; t += period) {
      constexpr double kHalf = 1e-4;  // [s]
      const Transform T = place(t);
      const Eigen::AngleAxisd turn(
          Eigen::Matrix3d(place(t - kHalf).linear().transpose() * place(t + kHalf).linear()));
      const Eigen::Vector3d acceleration(shifts_[0].second(t), shifts_[1].second(t), shifts_[2].second(t));
      out.push_back({kFirst + t + params_.time_offset,
                     turn.axis() * turn.angle() / (2 * kHalf) + gyro_bias + normal(params_.gyro_noise),
                     T.linear().transpose() * (acceleration + kGravity * up_) + accel_bias +
                         normal(params_.accel_noise)});
      gyro_bias += normal(params_.gyro_walk * std::sqrt(period));
      accel_bias += normal(params_.accel_walk * std::sqrt(period));
    }
  }

  const Board& board_;
  const CameraLens& lens_;
  const MotionParams& params_;
  std::mt19937& random_;
  Transform T_camera_imu_;
  Eigen::Vector3d up_;  // in the board's frame
  Waves turns_[3], shifts_[3];
};

}  // namespace

DrawnMotion drawMotion(const Board& board, const CameraLens& lens, const MotionParams& params,
                       std::mt19937& random) {
  return Draw(board, lens, params, random).run();
}

}  // namespace field_fusion::core
