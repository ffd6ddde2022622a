#include "field_fusion/core/calib/board.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace field_fusion::core {
namespace {

constexpr double kWorst = 3.0;  // [px] beyond it the corners are not this board's

Transform transformOf(const cv::Vec3d& turn, const cv::Vec3d& shift) {
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  Eigen::Matrix3d linear;
  cv::cv2eigen(rotation, linear);
  Transform T = Transform::Identity();
  T.linear() = linear;
  T.translation() << shift[0], shift[1], shift[2];
  return T;
}

/// Where the borders of the four squares meet: twice to four times nearer than the first search.
void sharpen(const cv::Mat& grey, std::vector<cv::Point2f>& corners) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) nearest = std::min(nearest, cv::norm(corners[i] - corners[i - 1]));
  const int half = std::clamp(static_cast<int>(0.4 * nearest), 2, 8);  // [px] of the window; no other corner in it
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3});
}

}  // namespace

std::vector<Eigen::Vector3d> Board::corners() const {
  std::vector<Eigen::Vector3d> out;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      out.emplace_back((column - 0.5 * (columns - 1)) * square, (row - 0.5 * (rows - 1)) * square, 0.0);
  return out;
}

Board parseBoard(const std::string& text) {
  static const std::regex form(R"((\d{1,3})x(\d{1,3})x(\d*\.?\d+))");
  std::smatch match;
  if (!std::regex_match(text, match, form))
    throw std::invalid_argument("board " + text + " is not COLUMNSxROWSxSQUARE, such as 8x6x0.108");
  const Board board{std::stoi(match[1]), std::stoi(match[2]), std::stod(match[3])};
  if (std::min(board.columns, board.rows) < 3)  // OpenCV looks for no fewer
    throw std::invalid_argument("board " + text + " has fewer than 3 inner corners in a row or column");
  if (!(board.square > 0)) throw std::invalid_argument("board " + text + " has squares of no size");
  return board;
}

std::optional<BoardView> locateBoard(const std::vector<Eigen::Vector2d>& corners, const Board& board,
                                     const CameraLens& lens) {
  const auto places = board.corners();
  const auto finite = [](const Eigen::Vector2d& p) { return p.allFinite(); };
  if (corners.size() != places.size() || !std::all_of(corners.begin(), corners.end(), finite)) return {};
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> pixels;
  for (const auto& p : places) objects.emplace_back(p.x(), p.y(), p.z());
  for (const auto& p : corners) pixels.emplace_back(p.x(), p.y());
  const Pinhole& c = lens.pinhole;
  const cv::Matx33d camera(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const std::vector<double> distortion(lens.distortion.begin(), lens.distortion.end());
  cv::Vec3d turn, shift;
  if (!cv::solvePnP(objects, pixels, camera, distortion, turn, shift, false, cv::SOLVEPNP_ITERATIVE)) return {};
  BoardView view{corners, transformOf(turn, shift), 0.0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d p = view.T_camera_board * places[i];
    if (!(p.z() > 0)) return {};
    view.error += (lens.project<double>(p) - corners[i]).squaredNorm();
  }
  view.error = std::sqrt(view.error / static_cast<double>(places.size()));
  if (!(view.error < kWorst)) return {};
  return view;
}

std::optional<BoardView> findBoard(const cv::Mat& grey, const Board& board, const CameraLens& lens) {
  if (grey.empty()) return {};
  std::vector<cv::Point2f> found;
  const int flags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY;
  if (!cv::findChessboardCornersSB(grey, {board.columns, board.rows}, found, flags)) return {};
  sharpen(grey, found);
  std::vector<Eigen::Vector2d> corners;
  for (const cv::Point2f& p : found) corners.emplace_back(p.x, p.y);
  return locateBoard(corners, board, lens);
}

}  // namespace field_fusion::core
