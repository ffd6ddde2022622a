#include "field_fusion/core/calib/extrinsics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field_fusion/core/base/median.h"
#include "joint_problem.h"

namespace field_fusion::core {
namespace {

constexpr double kOutlier = 3.0;    // times the median of the poses' residuals
constexpr double kAnyRange = 1e-3;  // [m] below which no pose is an outlier
constexpr double kAnyPixel = 0.3;   // [px] likewise
const double kUnsureTurn = radians(3.0);
constexpr double kUnsureShift = 0.15;  // [m]

void check(const Board& board, const std::vector<CalibrationPose>& poses, const Transform& T_camera_lidar) {
  const auto require = [](bool holds, const std::string& reason) {
    if (!holds) throw std::invalid_argument(reason);
  };
  require(T_camera_lidar.matrix().allFinite(), "the transform to start from is not finite");
  for (const CalibrationPose& pose : poses) {
    require(!pose.returns.empty(), pose.name + " has no returns");
    require(pose.view.T_camera_board.matrix().allFinite(), pose.name + ": the board's place is not finite");
    require(pose.view.corners.size() == board.corners().size(),
            pose.name + " has " + std::to_string(pose.view.corners.size()) + " corners, the board has " +
                std::to_string(board.corners().size()));
    for (const Eigen::Vector2d& corner : pose.view.corners)
      require(corner.allFinite(), pose.name + ": a corner is not finite");
    for (const BoardReturn& from : pose.returns)
      require(from.position.allFinite() && from.position.norm() > 0 && from.count > 0,
              pose.name + ": a return is not finite, at the LiDAR itself or of no measurement");
  }
}

template <class Of>
double medianOf(const std::vector<PoseResidual>& residuals, Of of) {
  std::vector<double> values;
  for (const PoseResidual& r : residuals) values.push_back(of(r));
  return median(std::move(values));
}

/// The worst pose among those still used if it is an outlier, else their number.
std::size_t outlier(const JointProblem& problem) {
  std::vector<PoseResidual> residuals;
  for (const PoseBlock& block : problem.blocks())
    residuals.push_back(problem.residual(*block.pose, block.T_camera_board));
  const double range = std::max(kAnyRange, kOutlier * medianOf(residuals, [](auto& r) { return r.rms; }));
  const double pixel = std::max(kAnyPixel, kOutlier * medianOf(residuals, [](auto& r) { return r.reprojection; }));
  const auto badness = [&](const PoseResidual& r) { return std::max(r.rms / range, r.reprojection / pixel); };
  const auto worst = std::max_element(residuals.begin(), residuals.end(),
                                      [&](auto& a, auto& b) { return badness(a) < badness(b); });
  return badness(*worst) > 1.0 ? static_cast<std::size_t>(worst - residuals.begin()) : residuals.size();
}

/// Solves without the poses that do not fit the rest; no more than a third of them.
void solveWithoutOutliers(JointProblem& problem) {
  const std::size_t fewest = std::max<std::size_t>(3, (2 * problem.blocks().size() + 2) / 3);
  problem.solve();
  while (problem.blocks().size() > fewest) {
    const std::size_t worst = outlier(problem);
    if (worst == problem.blocks().size()) return;
    problem.removePose(worst);
    problem.solve();
  }
}

std::vector<CalibrationPose> usedPoses(const JointProblem& problem) {
  std::vector<CalibrationPose> out;
  for (const PoseBlock& block : problem.blocks()) out.push_back(*block.pose);
  return out;
}

std::vector<PoseResidual> allResiduals(const JointProblem& problem, const std::vector<CalibrationPose>& poses) {
  std::vector<PoseResidual> out;
  for (const CalibrationPose& pose : poses) {
    const auto& used = problem.blocks();
    const auto block = std::find_if(used.begin(), used.end(), [&](auto& b) { return b.pose == &pose; });
    out.push_back(problem.residual(pose, block != used.end() ? block->T_camera_board : pose.view.T_camera_board));
    out.back().used = block != used.end();
  }
  return out;
}

void refuseUnsure(const Calibration& found) {
  if (found.rotationSigma() < kUnsureTurn && found.translationSigma() < kUnsureShift) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "the poses tell too little: standard deviations of %.1f deg and %.3f m are left; more poses, turned "
                "more, are needed",
                degrees(found.rotationSigma()), found.translationSigma());
  throw std::runtime_error(text);
}

}  // namespace

double Calibration::rotationSigma() const { return std::sqrt(covariance.diagonal().head<3>().sum()); }
double Calibration::translationSigma() const { return std::sqrt(covariance.diagonal().tail<3>().sum()); }

Calibration calibrate(const Board& board, const CameraLens& lens, std::vector<CalibrationPose> poses,
                      const Transform& T_camera_lidar, const CalibrationOptions& options) {
  check(board, poses, T_camera_lidar);
  if (const auto reason = degenerate(poses, T_camera_lidar); !reason.empty()) throw std::runtime_error(reason);
  JointProblem problem(board, lens, poses, T_camera_lidar, options);
  problem.solveCoarsely();
  solveWithoutOutliers(problem);
  Calibration found;
  found.T_camera_lidar = problem.T_camera_lidar();
  const auto used = usedPoses(problem);
  if (const auto reason = degenerate(used, found.T_camera_lidar); !reason.empty())
    throw std::runtime_error("without the outliers " + reason);
  if (!problem.covariance(found.covariance))
    throw std::runtime_error("the poses leave the transform unknown: its normal equations have no inverse");
  found.offsets = problem.offsets(), found.scale = problem.scale(), found.pixel_sigma = problem.pixelSigma();
  found.poses = allResiduals(problem, poses);
  std::vector<double> sigmas;
  for (const PoseBlock& block : problem.blocks()) sigmas.push_back(block.range_sigma);
  found.range_sigma = median(std::move(sigmas));
  refuseUnsure(found);
  return found;
}

RangeFactor rangeFactor(const Board& board, const CameraLens& lens, const std::vector<CalibrationPose>& poses,
                        const Calibration& found, const CalibrationOptions& options) {
  std::vector<CalibrationPose> used;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (found.poses.at(i).used) used.push_back(poses[i]);
  CalibrationOptions open = options;
  open.scale_sigma = 1.0;
  JointProblem problem(board, lens, used, found.T_camera_lidar, open);
  problem.solve();
  return {1.0 + problem.scale(), problem.scaleSigma()};
}

Calibration calibrateFromAnywhere(const Board& board, const CameraLens& lens, const std::vector<CalibrationPose>& poses,
                                  const CalibrationOptions& options) {
  check(board, poses, Transform::Identity());
  Transform best = Transform::Identity();
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 6; ++axis)  // where x points, and the four turns about it
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Eigen::Vector3d x = (axis < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(axis % 3);
      const Transform start(Eigen::AngleAxisd(radians(90.0 * quarter), x) *
                            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), x));
      JointProblem problem(board, lens, poses, start, options);
      const double cost = problem.solveCoarsely();
      if (cost < least) least = cost, best = problem.T_camera_lidar();
    }
  return calibrate(board, lens, poses, best, options);
}

}  // namespace field_fusion::core
