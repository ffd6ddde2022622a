#include "field_fusion/core/calib/board_draws.h"

#include <algorithm>

namespace field_fusion::core {
namespace {

const cv::Size kPicture(720, 540);

class Draw {
 public:
  Draw(const Board& board, const CameraLens& lens, const DrawParams& params, std::mt19937& random)
      : board_(board), lens_(lens), params_(params), random_(random) {}

  DrawnBoards run() {
    DrawnBoards out;
    out.T_camera_lidar = optical() * nearby(radians(0.2), 0.005) * mount();
    out.scale = scale_ = even(params_.range_scale);
    for (double& bias : biases_) bias = even(params_.range_bias);
    while (static_cast<int>(out.poses.size()) < params_.poses) {
      CalibrationPose pose;
      pose.name = "pose " + std::to_string(out.poses.size() + 1);
      const Transform T_camera_board = place();
      if (!look(T_camera_board, pose.view)) continue;
      pose.returns = measure((T_camera_board.inverse() * out.T_camera_lidar).inverse());
      if (pose.returns.size() >= 10) out.poses.push_back(pose);
    }
    return out;
  }

 private:
  double even(double limit) { return std::uniform_real_distribution<>(-limit, limit)(random_); }
  double normal(double sigma) { return sigma > 0 ? std::normal_distribution<>(0.0, sigma)(random_) : 0.0; }

  static Transform turned(double x, double y, double z) {
    return Transform(Eigen::AngleAxisd(z, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(y, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(x, Eigen::Vector3d::UnitX()));
  }
  /// T_optical_body: x forward, y left, z up to x right, y down, z forward.
  static Transform optical() {
    Transform T = Transform::Identity();
    T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return T;
  }
  /// As on paper 004's robot: the LiDAR behind and above the camera, which looks down a little.
  static Transform mount() {
    Transform T = turned(0.0, radians(-9.0), 0.0);
    T.translation() << -0.28, 0.01, 0.18;
    return T;
  }
  Transform nearby(double angle, double place) {
    Transform T = turned(even(angle), even(angle), even(angle));
    T.translation() << even(place), even(place), even(place);
    return T;
  }
  Transform place() {
    const double range = 2.1 + even(0.9), right = even(0.6), down = even(0.15);
    Transform T = turned(even(params_.tilt), even(params_.tilt), even(params_.tilt));
    T.translation() = range * Eigen::Vector3d(right, down, 1.0);
    return T;
  }

  bool look(const Transform& T_camera_board, BoardView& view) {
    view.T_camera_board = T_camera_board * nearby(radians(0.3), 0.005);  // the solver mends it
    for (const Eigen::Vector3d& corner : board_.corners()) {
      Eigen::Vector2d pixel = lens_.project<double>(T_camera_board * corner);
      pixel += Eigen::Vector2d(normal(params_.pixel_noise), normal(params_.pixel_noise));
      if (!(pixel.x() > 0 && pixel.y() > 0 && pixel.x() < kPicture.width && pixel.y() < kPicture.height))
        return false;
      view.corners.push_back(pixel);
    }
    return true;
  }

  /// A turn of the sensor; 1 degree between beams, as means of neighbours would lie.
  std::vector<BoardReturn> measure(const Transform& T_lidar_board) {
    std::vector<BoardReturn> out;
    const Transform T_board_lidar = T_lidar_board.inverse();
    for (int laser = 0; laser < (params_.flat ? 1 : 16); ++laser)
      for (double azimuth = radians(-60.0); azimuth < radians(60.0); azimuth += radians(1.0)) {
        const double elevation = params_.flat ? 0.0 : radians(-15.0 + 2.0 * laser);
        const Eigen::Vector3d ray = cartesian({1.0, azimuth, elevation});
        const double range = -T_board_lidar.translation().z() / (T_board_lidar.linear() * ray).z();
        const Eigen::Vector3d at = T_board_lidar * (range * ray);
        if (!(range > 0) || std::abs(at.x()) > board_.width() / 2 || std::abs(at.y()) > board_.height() / 2) continue;
        const double measured = range * (1.0 + scale_) + biases_[static_cast<std::size_t>(laser)] +
                                normal(params_.range_noise);
        out.push_back({measured * ray, laser, 1});
      }
    return out;
  }

  const Board& board_;
  const CameraLens& lens_;
  const DrawParams& params_;
  std::mt19937& random_;
  std::array<double, 16> biases_{};
  double scale_ = 0.0;
};

}  // namespace

DrawnBoards drawBoards(const Board& board, const CameraLens& lens, const DrawParams& params, std::mt19937& random) {
  return Draw(board, lens, params, random).run();
}

CameraLens usualLens() { return {{381.0, 381.0, 359.5, 269.5}, {-0.25, 0.06, 0.0, 0.0, -0.005, 0.0, 0.0, 0.0}}; }

}  // namespace field_fusion::core
