#include "field_fusion/core/calib/board_returns.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

#include "field_fusion/core/cloud/dbscan.h"
#include "field_fusion/core/cloud/plane.h"

namespace field_fusion::core {
namespace {

constexpr std::size_t kFewest = 10;  // returns
constexpr int kTries = 200;

using Indices = std::vector<std::uint32_t>;

bool isFlat(const Cloud& cloud) {
  return std::all_of(cloud.begin(), cloud.end(), [](const Point& p) { return p.z == 0.f; });
}

Indices inBox(const Cloud& cloud, const Transform& T_lidar_board, const Eigen::Vector3d& half) {
  Indices out;
  const Transform T_board_lidar = T_lidar_board.inverse();
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = T_board_lidar * cloud[i].position().cast<double>();
    if ((p.cwiseAbs().array() <= half.array()).all()) out.push_back(i);  // false for NaN
  }
  return out;
}

/// The upright plane through the line of a 2-D scan that holds most of the returns. Every pair is tried, of at most
/// kTries returns.
Plane bestLine(const Cloud& cloud, const Indices& near, double thickness) {
  Plane best;
  std::size_t most = 0;
  const std::size_t step = 1 + near.size() / kTries;
  for (std::size_t i = 0; i < near.size(); i += step)
    for (std::size_t k = i + step; k < near.size(); k += step) {
      const Eigen::Vector3d a = cloud[near[i]].position().cast<double>();
      const Eigen::Vector3d along = cloud[near[k]].position().cast<double>() - a;
      if (along.norm() < 3 * thickness) continue;
      Plane plane;
      plane.normal = Eigen::Vector3d(-along.y(), along.x(), 0.0).normalized();
      plane.offset = -plane.normal.dot(a);
      const auto count = static_cast<std::size_t>(std::count_if(near.begin(), near.end(), [&](std::uint32_t n) {
        return std::abs(plane.height(cloud[n].position().cast<double>())) < thickness;
      }));
      if (count > most) most = count, best = plane;
    }
  return best;
}

Plane bestPlane(const Cloud& cloud, const Indices& near, double thickness, const Eigen::Vector3d& normal,
                double least_cosine) {
  PlaneSearch search;
  search.sample(cloud, near, 1);
  Plane best;
  const auto alike = [&](Plane& plane) { return std::abs(plane.normal.dot(normal)) > least_cosine; };
  return search.run(thickness, kTries, alike, best) ? best : Plane();
}

Indices within(const Cloud& cloud, const Indices& near, const Plane& plane, double thickness) {
  Indices out;
  std::copy_if(near.begin(), near.end(), std::back_inserter(out), [&](std::uint32_t i) {
    return std::abs(plane.height(cloud[i].position().cast<double>())) < thickness;  // false for NaN
  });
  return out.size() < kFewest ? Indices() : out;
}

/// [m] of a piece along its axes, the longest first.
Eigen::Vector3d extents(const Cloud& cloud, const Indices& piece) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : piece) mean += cloud[i].position().cast<double>() / static_cast<double>(piece.size());
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : piece) {
    const Eigen::Vector3d d = cloud[i].position().cast<double>() - mean;
    squares += d * d.transpose() / static_cast<double>(piece.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(squares);
  // an even spread over a length L has the variance L^2 / 12
  return (12.0 * eigen.eigenvalues().array().max(0.0)).sqrt().reverse();
}

bool hasBoardSize(const Eigen::Vector3d& size, const Board& board, double thickness, bool flat) {
  const double narrow = std::min(board.width(), board.height()), wide = std::max(board.width(), board.height());
  const double diagonal = std::hypot(narrow, wide);
  if (flat) return size.x() > 0.7 * narrow && size.x() < 1.1 * diagonal && size.y() < 2 * thickness;
  return size.x() > 0.7 * wide && size.x() < 1.3 * wide && size.y() > 0.6 * narrow && size.y() < 1.4 * narrow &&
         size.z() < 2 * thickness;
}

}  // namespace

Indices returnsNear(const Cloud& cloud, const Board& board, const Transform& T_lidar_board,
                    const ReturnSearch& search) {
  const double half_w = board.width() / 2, half_h = board.height() / 2;
  const Indices near =
      inBox(cloud, T_lidar_board, {half_w + search.reach, half_h + search.reach, search.reach});
  if (near.size() < kFewest) return {};
  const Eigen::Vector3d normal = T_lidar_board.linear().col(2);
  const double least_cosine = std::cos(std::atan(2 * search.reach / std::min(half_w, half_h)));
  const Plane plane = isFlat(cloud) ? bestLine(cloud, near, search.thickness)
                                    : bestPlane(cloud, near, search.thickness, normal, least_cosine);
  return within(cloud, near, plane, search.thickness);
}

Indices returnsOn(const Cloud& cloud, const Board& board, const Transform& T_lidar_board, const ReturnSearch& search) {
  const Indices out = inBox(cloud, T_lidar_board, {board.width() / 2 - search.border, board.height() / 2 - search.border,
                                                   search.depth});
  return out.size() < kFewest ? Indices() : out;
}

std::vector<Indices> boardCandidates(const Cloud& cloud, const Board& board, const ReturnSearch& search) {
  constexpr float kGap = 0.2f;  // [m] rows of a 16-row LiDAR are so far apart at 5 m
  Dbscan dbscan;
  const std::vector<int>& labels = dbscan.runEuclidean(cloud, kGap);
  std::vector<Indices> pieces(static_cast<std::size_t>(dbscan.clusterCount())), out;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i] != kNoise) pieces[static_cast<std::size_t>(labels[i])].push_back(i);
  const bool flat = isFlat(cloud);
  for (const Indices& piece : pieces)
    if (piece.size() >= kFewest && hasBoardSize(extents(cloud, piece), board, search.thickness, flat))
      out.push_back(piece);
  return out;
}

void ReturnMeans::add(const Cloud& cloud, const Indices& indices) {
  const double cell = radians(0.5);
  for (const std::uint32_t i : indices) {
    const Eigen::Vector3d p = cloud[i].position().cast<double>();
    if (!p.allFinite() || p.norm() == 0.0) continue;
    const Polar at = polar(p);
    // a LiDAR that tells no rows: rows of its own, as far apart
    const int laser = cloud[i].ring == kUnknownRing ? 0 : cloud[i].ring;
    const int row = cloud[i].ring == kUnknownRing ? static_cast<int>(std::floor(at.elevation / cell)) : 0;
    Sum& sum = sums_[{laser, 4096 * row + static_cast<int>(std::floor(at.azimuth / cell))}];
    sum.position += p, ++sum.count;
  }
}

std::vector<BoardReturn> ReturnMeans::means() const {
  std::vector<BoardReturn> out;
  for (const auto& [key, sum] : sums_) out.push_back({sum.position / sum.count, key.first, sum.count});
  return out;
}

}  // namespace field_fusion::core
