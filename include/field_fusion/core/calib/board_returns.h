#pragma once
// Which returns of a cloud or 2-D scan are of the checkerboard. The paper (004, section 2.3) marks them by hand.
#include <string>
#include <vector>

#include "field_fusion/core/calib/extrinsics.h"

namespace field_fusion::core {

struct ReturnSearch {
  double reach = 0.15;      ///< [m] by which the board may lie elsewhere than guessed, along and across
  double thickness = 0.03;  ///< [m] within which of a plane (2-D: a line) the board's returns lie
  /// [m] before and behind the board within which returns are its own, once it is known: so wide that it cuts off nothing
  /// of noise and bias, for a cut on one side moves the mean
  double depth = 0.1;
  double border = 0.02;     ///< [m] inside of the outline where spots may be half beside the board; once it is known
};

/// Indices of the returns on the board, found about where `T_lidar_board` says: the best plane or line there, that is
/// within `reach` over the board's size of parallel. Empty where there is none of ten returns. A cloud whose points
/// have all z = 0 is a 2-D scan.
std::vector<std::uint32_t> returnsNear(const Cloud& cloud, const Board& board, const Transform& T_lidar_board,
                                       const ReturnSearch& search);

/// The same once it is well known where the board is: within the outline less `border`, and within `depth`.
std::vector<std::uint32_t> returnsOn(const Cloud& cloud, const Board& board, const Transform& T_lidar_board,
                                     const ReturnSearch& search);

/// Indices of the returns of each piece of the cloud that stands alone, is even and of the board's size: what may be
/// the board where nothing is known of it.
std::vector<std::vector<std::uint32_t>> boardCandidates(const Cloud& cloud, const Board& board,
                                                        const ReturnSearch& search);

/// Returns of a board that rests, scan after scan, as means of those of one laser that lie within half a degree.
/// Points that are not finite are left out.
class ReturnMeans {
 public:
  void add(const Cloud& cloud, const std::vector<std::uint32_t>& indices);
  std::vector<BoardReturn> means() const;

 private:
  struct Sum {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::map<std::pair<int, int>, Sum> sums_;  // laser, direction
};

}  // namespace field_fusion::core
