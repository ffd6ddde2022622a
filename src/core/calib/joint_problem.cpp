#include "joint_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "field_fusion/core/base/median.h"
#include "joint_residuals.h"

namespace field_fusion::core {
namespace {

constexpr double kRobust = 3.0;                  // sigmas from where on a residual counts linearly (Huber)
constexpr double kAngleSigma = radians(0.02);    // of a beam's direction; what a scanner's steps leave
constexpr double kLeastRange = 1e-4, kLeastPixel = 1e-2;  // [m], [px] no sensor is better, and no weight infinite
constexpr double kGrazing = 0.1;                 // cosine of the incidence below which nothing gets better known
constexpr double kCoarse = 1e-7, kFine = 1e-12;  // relative changes at which a search ends
constexpr int kRounds = 3;                       // of measuring the noise

/// The true place of a measured one.
Eigen::Vector3d corrected(const Eigen::Vector3d& p, double offset, double scale) {
  const double range = p.norm();
  return p * ((range - offset) / (range * (1.0 + scale)));
}

}  // namespace

JointProblem::JointProblem(const Board& board, const CameraLens& lens, const std::vector<CalibrationPose>& poses,
                           const Transform& T_camera_lidar, const CalibrationOptions& options)
    : lens_(lens),
      options_(options),
      corners_(board.corners()),
      T_camera_lidar_(T_camera_lidar),
      pixel_sigma_(options.pixel_sigma) {
  for (const CalibrationPose& pose : poses) {
    blocks_.push_back({&pose, pose.view.T_camera_board, {}, options.range_sigma});
    for (const BoardReturn& from : pose.returns) offsets_[from.laser] = 0.0;
  }
}

/// [m] along the ray: the noise of the range, and that of the direction by the slant.
double JointProblem::sigma(const PoseBlock& block, const BoardReturn& from) const {
  const Eigen::Vector3d ray = T_camera_lidar_.linear() * from.position;
  const double range = ray.norm();
  const double cosine =
      std::max(kGrazing, std::abs(block.T_camera_board.linear().col(2).dot(ray)) / range);
  const double slope = std::sqrt(std::max(0.0, 1.0 / (cosine * cosine) - 1.0));
  return std::hypot(block.range_sigma, kAngleSigma * range * slope) / std::sqrt(from.count);
}

void JointProblem::addPriors(ceres::Problem& problem) {
  const auto prior = [&problem](double* x, double sigma) {
    if (!(sigma > 0)) return problem.SetParameterBlockConstant(x);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior, 1, 1>(new Prior{sigma}), nullptr, x);
  };
  for (auto& [laser, offset] : offsets_)
    if (problem.HasParameterBlock(&offset)) prior(&offset, options_.offset_sigma);
  prior(&scale_, options_.scale_sigma);
}

void JointProblem::addReturns(ceres::Problem& problem, PoseBlock& block) {
  using OfRange = ceres::AutoDiffCostFunction<RangeResidual, 1, 6, 6, 1, 1>;
  for (const BoardReturn& from : block.pose->returns)
    problem.AddResidualBlock(
        new OfRange(new RangeResidual{T_camera_lidar_, block.T_camera_board, from.position, sigma(block, from)}),
        new ceres::HuberLoss(kRobust), x_.data(), block.x.data(), &offsets_.at(from.laser), &scale_);
}

void JointProblem::addCorners(ceres::Problem& problem, PoseBlock& block) {
  using OfCorner = ceres::AutoDiffCostFunction<CornerResidual, 2, 6>;
  for (std::size_t i = 0; i < corners_.size(); ++i)
    problem.AddResidualBlock(new OfCorner(new CornerResidual{lens_, block.T_camera_board, corners_[i],
                                                             block.pose->view.corners[i], pixel_sigma_}),
                             new ceres::HuberLoss(kRobust), block.x.data());
}

void JointProblem::build(ceres::Problem& problem) {
  for (PoseBlock& block : blocks_) {
    addReturns(problem, block);
    addCorners(problem, block);
  }
  addPriors(problem);
}

double JointProblem::minimise(ceres::Problem& problem, ceres::LinearSolverType solver, double tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = solver;
  if (solver == ceres::DENSE_SCHUR) {
    auto* order = new ceres::ParameterBlockOrdering;
    std::vector<double*> all;
    problem.GetParameterBlocks(&all);
    for (double* block : all) order->AddElementToGroup(block, 1);
    for (PoseBlock& block : blocks_) order->AddElementToGroup(block.x.data(), 0);  // eliminated first
    options.linear_solver_ordering.reset(order);
  }
  options.max_num_iterations = 100;
  options.function_tolerance = options.parameter_tolerance = tolerance, options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  T_camera_lidar_ = T_camera_lidar_ * motion(x_);
  x_.fill(0.0);
  for (PoseBlock& block : blocks_) {
    block.T_camera_board = block.T_camera_board * motion(block.x);
    block.x.fill(0.0);
  }
  return summary.IsSolutionUsable() ? summary.final_cost : std::numeric_limits<double>::infinity();
}

double JointProblem::solveCoarsely() {
  using OfPoint = ceres::AutoDiffCostFunction<PointResidual, 1, 6, 6>;
  ceres::Problem problem;
  for (PoseBlock& block : blocks_) {
    for (const BoardReturn& from : block.pose->returns)
      problem.AddResidualBlock(
          new OfPoint(new PointResidual{T_camera_lidar_, block.T_camera_board, from.position, block.range_sigma}),
          new ceres::HuberLoss(kRobust), x_.data(), block.x.data());
    problem.SetParameterBlockConstant(block.x.data());
  }
  return minimise(problem, ceres::DENSE_QR, kCoarse);
}

void JointProblem::solve() {
  for (int i = 0; i <= kRounds; ++i) {
    if (i > 0) measureNoise();
    ceres::Problem problem;
    build(problem);
    minimise(problem, ceres::DENSE_SCHUR, i < kRounds ? kCoarse : kFine);
  }
}

std::vector<double> JointProblem::distances(const PoseBlock& block) const {
  std::vector<double> out;
  const Transform T_board_lidar = block.T_camera_board.inverse() * T_camera_lidar_;
  for (const BoardReturn& from : block.pose->returns)
    out.push_back((T_board_lidar * corrected(from.position, offsets_.at(from.laser), scale_)).z());
  return out;
}

std::vector<double> JointProblem::rangeErrors(const PoseBlock& block) const {
  std::vector<double> out;
  const double still[6] = {};
  for (const BoardReturn& from : block.pose->returns) {
    RangeResidual{T_camera_lidar_, block.T_camera_board, from.position, sigma(block, from)}(
        still, still, &offsets_.at(from.laser), &scale_, &out.emplace_back());
    out.back() = std::abs(out.back());
  }
  return out;
}

/// Of the corners over all poses, of the ranges pose by pose, for it grows with slant and range. Few returns tell
/// little of it and count with all others'.
void JointProblem::measureNoise() {
  std::vector<double> pixels, all;
  for (const PoseBlock& block : blocks_) {
    for (const double error : rangeErrors(block)) all.push_back(error * block.range_sigma);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Eigen::Vector2d d =
          lens_.project<double>(block.T_camera_board * corners_[i]) - block.pose->view.corners[i];
      pixels.insert(pixels.end(), {std::abs(d.x()), std::abs(d.y())});
    }
  }
  const double usual = sigmaByMedian(std::move(all));
  for (PoseBlock& block : blocks_) {
    constexpr double kUsual = 50.0;  // returns that the noise of all poses counts for
    const double n = static_cast<double>(block.pose->returns.size());
    const double own = block.range_sigma * sigmaByMedian(rangeErrors(block));
    block.range_sigma =
        std::max(kLeastRange, std::sqrt((kUsual * usual * usual + n * own * own) / (kUsual + n)));
  }
  // six numbers were fitted to the corners of each pose
  const double freedom = 1.0 - 3.0 / static_cast<double>(corners_.size());
  pixel_sigma_ = std::max(kLeastPixel, sigmaByMedian(std::move(pixels)) / std::sqrt(freedom));
}

bool JointProblem::covarianceOf(double* block, double* row_major) {
  ceres::Problem problem;
  build(problem);
  ceres::Covariance::Options options;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;  // SuiteSparse's threads get in each other's way
  ceres::Covariance covariance(options);
  const std::vector<std::pair<const double*, const double*>> blocks{{block, block}};
  return covariance.Compute(blocks, &problem) && covariance.GetCovarianceBlock(block, block, row_major);
}

bool JointProblem::covariance(Eigen::Matrix<double, 6, 6>& out) {
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> values;
  if (!covarianceOf(x_.data(), values.data())) return false;
  out = values;
  return true;
}

double JointProblem::scaleSigma() {
  double variance = 0.0;
  return covarianceOf(&scale_, &variance) ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

PoseResidual JointProblem::residual(const CalibrationPose& pose, const Transform& T_camera_board) const {
  PoseResidual out;
  out.name = pose.name;
  const std::vector<double> off = distances({&pose, T_camera_board, {}, 0.0});
  double sum = 0, squares = 0, weight = 0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double w = pose.returns[i].count;
    sum += w * off[i], squares += w * off[i] * off[i], weight += w;
  }
  out.returns = static_cast<std::size_t>(weight);
  out.mean = sum / weight, out.rms = std::sqrt(squares / weight);
  for (std::size_t i = 0; i < corners_.size(); ++i)
    out.reprojection += (lens_.project<double>(T_camera_board * corners_[i]) - pose.view.corners[i]).squaredNorm();
  out.reprojection = std::sqrt(out.reprojection / static_cast<double>(corners_.size()));
  return out;
}

}  // namespace field_fusion::core
