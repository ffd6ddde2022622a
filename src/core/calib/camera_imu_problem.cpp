#include "camera_imu_problem.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "camera_imu_residuals.h"
#include "field_fusion/core/base/median.h"

namespace field_fusion::core {
namespace {

constexpr double kRobust = 2.0;    // times the usual size of a block from where on it counts linearly (Huber)
constexpr double kBiasStep = 5.0;  // [s]
constexpr double kCoarse = 1e-5, kFine = 1e-10;  // relative changes at which a search ends
constexpr int kRounds = 3;                       // of measuring the noise
constexpr int kProbes = 8;                       // that tell how many of the residuals the search followed
constexpr double kLeastPixel = 1e-3, kLeastRate = 1e-6, kLeastForce = 1e-5;  // no weight is infinite
const double kMostTurn = radians(300.0);  // of the rotation vector, which is ambiguous at 360

/// Where the camera was at a time of its own clock; beyond the first and last place, there.
Transform cameraAt(const std::vector<CameraPlace>& places, double time) {
  if (time <= places.front().stamp) return places.front().T_board_camera;
  if (time >= places.back().stamp) return places.back().T_board_camera;
  const auto after = std::upper_bound(places.begin(), places.end(), time,
                                      [](double t, const CameraPlace& place) { return t < place.stamp; });
  const CameraPlace &a = *(after - 1), &b = *after;
  const double share = (time - a.stamp) / (b.stamp - a.stamp);
  const Eigen::Quaterniond from(a.T_board_camera.linear()), to(b.T_board_camera.linear());
  Transform T(from.slerp(share, to));
  T.translation() = (1 - share) * a.T_board_camera.translation() + share * b.T_board_camera.translation();
  return T;
}

/// The vector of the same rotation that lies nearest to another.
Eigen::Vector3d turnNear(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& other) {
  const Eigen::AngleAxisd turn(rotation);
  const double whole = radians(360.0);
  const double ahead = std::round((other.dot(turn.axis()) - turn.angle()) / whole);
  return turn.axis() * (turn.angle() + whole * ahead);
}

Eigen::Matrix3d meanRotation(const std::vector<CameraPlace>& places) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const CameraPlace& place : places) sum += place.T_board_camera.linear();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double side = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Eigen::Vector3d(1, 1, side).asDiagonal() * svd.matrixV().transpose();
}

template <class Iterator>
std::vector<double> sizes(Iterator begin, Iterator end) {
  std::vector<double> out;
  for (; begin != end; ++begin) out.push_back(std::abs(*begin));
  return out;
}

ceres::LossFunction* robust(double count) { return new ceres::HuberLoss(kRobust * std::sqrt(count)); }

}  // namespace

CameraImuProblem::CameraImuProblem(const Board& board, const CameraLens& lens,
                                   std::vector<CameraPlace> places, std::vector<ImuReading> readings,
                                   const CameraImuStart& start, const CameraImuOptions& options)
    : lens_(lens),
      options_(options),
      corners_(board.corners()),
      T_camera_imu_(start.R_camera_imu),
      time_offset_(start.time_offset) {
  const double begin = std::max(places.front().stamp + time_offset_, readings.front().stamp);
  const double end = std::min(places.back().stamp + time_offset_, readings.back().stamp);
  for (ImuReading& reading : readings)
    if (reading.stamp >= begin && reading.stamp <= end) readings_.push_back(reading);
  for (const CameraPlace& place : places)
    if (place.stamp + time_offset_ >= begin && place.stamp + time_offset_ <= end) places_.push_back(place);
  const double interval = (end - begin) / static_cast<double>(readings_.size());
  grid_ = SplineGrid::over(begin, end, std::max(1.0 / options.knots, 4.0 * interval));
  bias_grid_ = SplineGrid::over(begin, end, kBiasStep);
  placePoints(places);
  findUp(places);
  Six bias{};
  std::copy_n(start.gyro_bias.data(), 3, bias.begin());
  biases_.assign(static_cast<std::size_t>(bias_grid_.segments + 1), bias);
}

/// A spline whose control points are values of a smooth motion follows it nearly.
void CameraImuProblem::placePoints(const std::vector<CameraPlace>& places) {
  R_board_reference_ = meanRotation(places_) * T_camera_imu_.linear();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (int j = 0; j < grid_.points(); ++j) {
    const Transform T_board_imu = cameraAt(places, grid_.centre(j) - time_offset_) * T_camera_imu_;
    turn = turnNear(R_board_reference_.transpose() * T_board_imu.linear(), turn);
    if (turn.norm() > kMostTurn)
      throw std::runtime_error("the camera is turned on and on: turn it back and forth");
    const Eigen::Vector3d at = T_board_imu.translation();
    points_.push_back({turn.x(), turn.y(), turn.z(), at.x(), at.y(), at.z()});
  }
}

/// By the mean of the forces, for who comes back has not been accelerated on average.
void CameraImuProblem::findUp(const std::vector<CameraPlace>& places) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const ImuReading& reading : readings_)
    sum += cameraAt(places, reading.stamp - time_offset_).linear() * T_camera_imu_.linear() * reading.force;
  R_board_up_ = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), sum);
}

void CameraImuProblem::addPictures(ceres::Problem& problem) {
  const double count = 2.0 * static_cast<double>(corners_.size());
  for (const CameraPlace& place : places_) {
    const double time = place.stamp + time_offset_;
    const int segment = grid_.segment(time);
    Six* p = &points_[static_cast<std::size_t>(segment)];
    auto* cost =
        costOf(PictureResidual{lens_, corners_, place.corners, R_board_reference_, T_camera_imu_,
                               (time - grid_.start(segment)) / grid_.step, grid_.step, pictures_.sigma});
    pictures_.blocks.push_back(problem.AddResidualBlock(cost, robust(count), p[0].data(), p[1].data(),
                                                        p[2].data(), p[3].data(), p[4].data(), p[5].data(),
                                                        x_.data(), &t_));
  }
}

void CameraImuProblem::addReadings(ceres::Problem& problem) {
  for (const ImuReading& reading : readings_) {
    const int segment = grid_.segment(reading.stamp), between = bias_grid_.segment(reading.stamp);
    const double u = (reading.stamp - grid_.start(segment)) / grid_.step;
    const double share = (reading.stamp - bias_grid_.start(between)) / bias_grid_.step;
    Six* p = &points_[static_cast<std::size_t>(segment)];
    Six* bias = &biases_[static_cast<std::size_t>(between)];
    gyro_.blocks.push_back(problem.AddResidualBlock(
        costOf(GyroResidual{reading.rate, u, grid_.step, share, gyro_.sigma}), robust(3), p[0].data(),
        p[1].data(), p[2].data(), p[3].data(), p[4].data(), p[5].data(), bias[0].data(), bias[1].data()));
    accel_.blocks.push_back(
        problem.AddResidualBlock(costOf(AccelResidual{reading.force, R_board_reference_, R_board_up_, u,
                                                      grid_.step, share, accel_.sigma}),
                                 robust(3), p[0].data(), p[1].data(), p[2].data(), p[3].data(), p[4].data(),
                                 p[5].data(), bias[0].data(), bias[1].data(), tilt_.data()));
  }
}

void CameraImuProblem::build(ceres::Problem& problem) {
  for (auto* blocks : {&pictures_.blocks, &gyro_.blocks, &accel_.blocks, &walks_}) blocks->clear();
  addPictures(problem);
  addReadings(problem);
  const double root = std::sqrt(bias_grid_.step);
  for (std::size_t i = 1; i < biases_.size(); ++i)
    walks_.push_back(
        problem.AddResidualBlock(costOf(BiasWalk{options_.gyro_walk * root, options_.accel_walk * root}),
                                 nullptr, biases_[i - 1].data(), biases_[i].data()));
}

/// What is found goes into the places from which the small numbers count; they are zero then.
void CameraImuProblem::minimise(double tolerance) {
  ceres::Problem problem;
  build(problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.max_num_iterations = 50;
  options.function_tolerance = options.parameter_tolerance = tolerance, options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable())
    throw std::runtime_error("the search for the unit's place failed: " + summary.message);
  T_camera_imu_ = T_camera_imu_ * motion(x_);
  time_offset_ += t_;
  R_board_up_ =
      (R_board_up_ * Eigen::Quaterniond(rotationOf<double>({tilt_[0], tilt_[1], 0.0}))).normalized();
  x_.fill(0.0), tilt_.fill(0.0), t_ = 0.0;
}

void CameraImuProblem::solve() {
  for (int i = 0; i <= kRounds; ++i) {
    if (i > 0) measureNoise();
    minimise(i < kRounds ? kCoarse : kFine);
  }
}

CameraImuProblem::Linear CameraImuProblem::linearised() {
  ceres::Problem problem;
  build(problem);
  ceres::Problem::EvaluateOptions options;
  for (const auto* blocks : {&pictures_.blocks, &gyro_.blocks, &accel_.blocks, &walks_})
    options.residual_blocks.insert(options.residual_blocks.end(), blocks->begin(), blocks->end());
  for (auto* blocks : {&points_, &biases_})
    for (Six& block : *blocks) options.parameter_blocks.push_back(block.data());
  for (double* block : {tilt_.data(), x_.data(), &t_}) options.parameter_blocks.push_back(block);
  Linear out;
  ceres::CRSMatrix rows;
  if (!problem.Evaluate(options, nullptr, &out.residuals, nullptr, &rows))
    throw std::runtime_error("the search for the unit's place ended behind the board");
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  out.jacobian =
      Eigen::Map<const RowMajor>(rows.num_rows, rows.num_cols, static_cast<Eigen::Index>(rows.values.size()),
                                 rows.rows.data(), rows.cols.data(), rows.values.data());
  out.pictures = static_cast<Eigen::Index>(2 * corners_.size() * places_.size());
  out.gyro = out.accel = static_cast<Eigen::Index>(3 * readings_.size());
  return out;
}

/// Of what the spline leaves, it has taken a part along: as many numbers of each kind as the trace of J H^-1
/// J^T has there (Foerstner 1979), which random signs tell (Hutchinson 1990).
void CameraImuProblem::measureNoise() {
  const Linear linear = linearised();
  const Eigen::SparseMatrix<double> normal = linear.jacobian.transpose() * linear.jacobian;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inverse(normal);
  if (inverse.info() != Eigen::Success)
    throw std::runtime_error("the recording leaves something unknown: no inverse");
  std::mt19937 random(1);
  Eigen::Index first = 0;
  const auto measured = [&](Kind& kind, Eigen::Index count, double least) {
    double followed = 0;
    for (int probe = 0; probe < kProbes; ++probe) {
      Eigen::VectorXd signs = Eigen::VectorXd::Zero(linear.jacobian.rows());
      for (Eigen::Index i = first; i < first + count; ++i) signs[i] = random() % 2 ? 1.0 : -1.0;
      const Eigen::VectorXd seen = linear.jacobian.transpose() * signs;
      followed += seen.dot(inverse.solve(seen)) / kProbes;
    }
    const auto begin = linear.residuals.begin() + first;
    const double freedom = std::max(0.05, 1.0 - followed / static_cast<double>(count));
    kind.sigma =
        std::max(least, kind.sigma * sigmaByMedian(sizes(begin, begin + count)) / std::sqrt(freedom));
    first += count;
  };
  measured(pictures_, linear.pictures, kLeastPixel);
  measured(gyro_, linear.gyro, kLeastRate);
  measured(accel_, linear.accel, kLeastForce);
}

CameraImuCalibration CameraImuProblem::result() {
  const Linear linear = linearised();
  const Eigen::SparseMatrix<double> normal = linear.jacobian.transpose() * linear.jacobian;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inverse(normal);
  if (inverse.info() != Eigen::Success)
    throw std::runtime_error("the recording leaves something unknown: no inverse");
  CameraImuCalibration out;
  Eigen::MatrixXd last = Eigen::MatrixXd::Zero(normal.rows(), 7);
  last.bottomRows<7>().setIdentity();
  out.covariance = inverse.solve(last).bottomRows<7>();
  out.T_camera_imu = T_camera_imu_, out.time_offset = time_offset_;
  out.gravity = R_board_up_ * Eigen::Vector3d(0, 0, -kGravity);
  out.gyro_bias = out.accel_bias = Eigen::Vector3d::Zero();
  for (const Six& bias : biases_) {
    out.gyro_bias += Eigen::Map<const Eigen::Vector3d>(bias.data()) / static_cast<double>(biases_.size());
    out.accel_bias +=
        Eigen::Map<const Eigen::Vector3d>(bias.data() + 3) / static_cast<double>(biases_.size());
  }
  out.pixel_sigma = pictures_.sigma, out.gyro_sigma = gyro_.sigma, out.accel_sigma = accel_.sigma;
  out.frames = places_.size(), out.readings = readings_.size();
  double squares = 0;
  for (Eigen::Index i = 0; i < linear.pictures; ++i)
    squares += std::pow(linear.residuals[static_cast<std::size_t>(i)], 2);
  out.reprojection = pictures_.sigma * std::sqrt(2.0 * squares / static_cast<double>(linear.pictures));
  return out;
}

}  // namespace field_fusion::core
