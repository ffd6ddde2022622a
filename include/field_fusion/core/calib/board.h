#pragma once
// The checkerboard that camera and LiDAR see, and where the camera sees it.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/detect/bearing.h"

namespace field_fusion::core {

/// Frame: origin in the middle, x along a row, y along a column, z away from who looks at the print.
struct Board {
  int columns = 0, rows = 0;  ///< inner corners, one less than squares; 2 at least
  double square = 0.0;        ///< [m]

  double width() const { return (columns + 1) * square; }  ///< [m] of the squares, without a margin
  double height() const { return (rows + 1) * square; }    ///< [m]
  std::vector<Eigen::Vector3d> corners() const;            ///< [m] row by row
};

/// From "COLUMNSxROWSxSQUARE", such as 8x6x0.108. Throws std::invalid_argument that says what is wrong.
Board parseBoard(const std::string& text);

/// A camera as received, before rectification: OpenCV's k1 k2 p1 p2 k3 k4 k5 k6 (plumb_bob, rational_polynomial).
struct CameraLens {
  Pinhole pinhole;
  std::array<double, 8> distortion{};

  /// [px] of a point in the camera's optical frame. Templated for automatic differentiation.
  template <class T>
  Eigen::Matrix<T, 2, 1> project(const Eigen::Matrix<T, 3, 1>& p) const {
    const auto& d = distortion;
    const T x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
    const T radial =
        (1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]))) / (1.0 + r2 * (d[5] + r2 * (d[6] + r2 * d[7])));
    const T u = x * radial + 2.0 * d[2] * x * y + d[3] * (r2 + 2.0 * x * x);
    const T v = y * radial + d[2] * (r2 + 2.0 * y * y) + 2.0 * d[3] * x * y;
    return {pinhole.fx * u + pinhole.cx, pinhole.fy * v + pinhole.cy};
  }
};

struct BoardView {
  std::vector<Eigen::Vector2d> corners;  ///< [px] in the order of Board::corners, or from the last to the first
  Transform T_camera_board;
  double error = 0.0;  ///< [px] root mean square of what the pose leaves
};

/// Where the corners found show the board. Nothing where they are of another number, not finite, or fit no pose in
/// front of the camera.
std::optional<BoardView> locateBoard(const std::vector<Eigen::Vector2d>& corners, const Board& board,
                                     const CameraLens& lens);

/// The same from a grey picture (CV_8UC1). Nothing where the board is not in it as a whole.
std::optional<BoardView> findBoard(const cv::Mat& grey, const Board& board, const CameraLens& lens);

}  // namespace field_fusion::core
