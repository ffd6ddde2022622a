#include "field_fusion/core/calib/board.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "field_fusion/core/calib/board_draws.h"
#include "field_fusion/core/calib/chart.h"

namespace field_fusion::core {
namespace {

using testing::HasSubstr;

const Board kBoard{8, 6, 0.1};

Transform before(double range, double right) {
  Transform T(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitY()));
  T.translation() << right, 0.1, range;
  return T;
}

/// Pixel by pixel, the mean of 8 x 8 rays each; a grey room about a white margin of one square.
cv::Mat picture(const Transform& T_camera_board, const CameraLens& lens) {
  constexpr int kRays = 8;
  cv::Mat image(540, 720, CV_8UC1);
  const Transform T_board_camera = T_camera_board.inverse();
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      double sum = 0;
      for (int i = 0; i < kRays * kRays; ++i) {
        const double x = u + (i % kRays + 0.5) / kRays - 0.5, y = v + (i / kRays + 0.5) / kRays - 0.5;
        const Eigen::Vector3d ray = T_board_camera.linear() * Eigen::Vector3d((x - lens.pinhole.cx) / lens.pinhole.fx,
                                                                             (y - lens.pinhole.cy) / lens.pinhole.fy, 1);
        const Eigen::Vector3d p =
            T_board_camera.translation() - ray * (T_board_camera.translation().z() / ray.z());
        const double column = p.x() / 0.1 + 4.5, row = p.y() / 0.1 + 3.5;
        const bool print = column > 0 && column < 9 && row > 0 && row < 7;
        const bool plate = column > -1 && column < 10 && row > -1 && row < 8;
        const bool dark = (static_cast<int>(std::floor(column)) + static_cast<int>(std::floor(row))) % 2 == 0;
        sum += !plate ? 110 : print && dark ? 20 : 220;
      }
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(sum / (kRays * kRays));
    }
  return image;
}

CameraLens pinhole() { return {{381.0, 381.0, 359.5, 269.5}, {}}; }

TEST(Board, IsReadFromText) {
  const Board board = parseBoard("8x6x0.108");
  EXPECT_EQ(board.columns, 8);
  EXPECT_EQ(board.rows, 6);
  EXPECT_DOUBLE_EQ(board.square, 0.108);
  EXPECT_DOUBLE_EQ(board.width(), 9 * 0.108);
  EXPECT_EQ(board.corners().size(), 48u);
  EXPECT_TRUE(board.corners().front().isApprox(Eigen::Vector3d(-3.5 * 0.108, -2.5 * 0.108, 0)));
  EXPECT_TRUE(board.corners()[1].isApprox(Eigen::Vector3d(-2.5 * 0.108, -2.5 * 0.108, 0)));
}

TEST(Board, TextThatIsNoneIsRefusedWithTheReason) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parseBoard(text);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  for (const char* text : {"", "8x6", "8x6x", "8x6xnan", "-8x6x0.1", "8x6x0.1m", "8 x 6 x 0.1", "9999x6x0.1"})
    EXPECT_THAT(refusal(text), HasSubstr("is not COLUMNSxROWSxSQUARE")) << text;
  EXPECT_THAT(refusal("2x6x0.1"), HasSubstr("fewer than 3"));
  EXPECT_THAT(refusal("8x6x0.0"), HasSubstr("squares of no size"));
}

TEST(Board, IsFoundInAPictureWhereItWasDrawn) {
  const Transform T = before(2.0, 0.2);
  const auto view = findBoard(picture(T, pinhole()), kBoard, pinhole());
  ASSERT_TRUE(view);
  Transform found = view->T_camera_board;
  if (found.linear().col(0).dot(T.linear().col(0)) < 0) found.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
  const auto off = chartOf(T, found);
  EXPECT_LT(off.head<3>().norm(), radians(0.1));
  EXPECT_LT(off.tail<3>().norm(), 0.002);
  EXPECT_LT(view->error, 0.1);

}

TEST(Board, HalfOutOfThePictureIsNotFound) {
  EXPECT_FALSE(findBoard(picture(before(2.0, 2.0), pinhole()), kBoard, pinhole()));
}

TEST(Board, NothingIsFoundInAnEmptyOrEvenPicture) {
  EXPECT_FALSE(findBoard({}, kBoard, pinhole()));
  EXPECT_FALSE(findBoard(cv::Mat(540, 720, CV_8UC1, cv::Scalar(128)), kBoard, pinhole()));
}

TEST(Board, PoseComesBackThroughADistortedLens) {
  const CameraLens lens = usualLens();
  const Transform T = before(2.0, -0.3);
  std::vector<Eigen::Vector2d> corners;
  for (const auto& p : kBoard.corners()) corners.push_back(lens.project<double>(T * p));
  const auto view = locateBoard(corners, kBoard, lens);
  ASSERT_TRUE(view);
  EXPECT_LT(chartOf(T, view->T_camera_board).norm(), 1e-5);
  EXPECT_LT(view->error, 1e-4);
  // from the last to the first: the same board, turned by half
  const auto turned = locateBoard({corners.rbegin(), corners.rend()}, kBoard, lens);
  ASSERT_TRUE(turned);
  EXPECT_TRUE(turned->T_camera_board.linear().col(2).isApprox(T.linear().col(2), 1e-4));
}

TEST(Board, CornersThatAreNotItsOwnHaveNoPose) {
  const CameraLens lens = usualLens();
  std::vector<Eigen::Vector2d> corners;
  for (const auto& p : kBoard.corners()) corners.push_back(lens.project<double>(before(2.0, 0.0) * p));
  auto wrong = corners;
  wrong[10].x() += 100.0;
  EXPECT_FALSE(locateBoard(wrong, kBoard, lens));
  wrong = corners;
  wrong[0].x() = kNaN;
  EXPECT_FALSE(locateBoard(wrong, kBoard, lens));
  wrong = corners;
  wrong.pop_back();
  EXPECT_FALSE(locateBoard(wrong, kBoard, lens));
  EXPECT_FALSE(locateBoard({}, kBoard, lens));
}

}  // namespace
}  // namespace field_fusion::core
