#include "field_fusion/core/sim/scene_camera.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace field_fusion::core {
namespace {

Body box(Eigen::Vector2d middle, Eigen::Vector3d size) {
  return {"box", Body::Shape::kBox, size, middle, {0, 0}, 10.0, {0, 0, 255}};
}

ScenePicture pictureOf(const Scene& scene) { return picture(scene, 0.0, SceneCamera()); }

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

TEST(SceneCamera, OfAnEmptySceneIsSkyOverGround) {
  const ScenePicture out = pictureOf({});
  EXPECT_EQ(out.image.size(), cv::Size(1280, 720));
  EXPECT_EQ(out.image.type(), CV_8UC3);
  EXPECT_TRUE(out.views.empty());
  EXPECT_NE(out.image.at<cv::Vec3b>(300, 640), out.image.at<cv::Vec3b>(420, 640));
}

TEST(SceneCamera, BoxIsTheProjectionOfTheNearFace) {
  // the camera is at (0.1, 0, 1.6): the near face is 9.4 m away, 1 m wide, from 1.6 m below to 0.4 m above it
  const View view = pictureOf({box({10, 0}, {1, 1, 2})}).views[0];
  const double scale = 800.0 / 9.4;
  EXPECT_NEAR(view.box.x_min, 640.0 - 0.5 * scale, 1e-3);
  EXPECT_NEAR(view.box.x_max, 640.0 + 0.5 * scale, 1e-3);
  EXPECT_NEAR(view.box.y_min, 360.0 - 0.4 * scale, 1e-3);
  EXPECT_NEAR(view.box.y_max, 360.0 + 1.6 * scale, 1e-3);
  EXPECT_EQ(view.visible, 1.0);
}

TEST(SceneCamera, LeftIsLeft) {
  const View view = pictureOf({box({10, 3}, {1, 1, 2})}).views[0];
  EXPECT_LT(view.box.x_max, 640.0);
}

TEST(SceneCamera, ACylinderReachesFromTangentToTangent) {
  Body body = box({10, 2}, {1, 1, 2});
  body.shape = Body::Shape::kCylinder;
  const ImageBox seen = pictureOf({body}).views[0].box;
  const double middle = std::atan2(2.0, 9.9), half = std::asin(0.5 / std::hypot(2.0, 9.9));
  EXPECT_NEAR(seen.x_min, 640.0 - 800.0 * std::tan(middle + half),
              0.3);  // 32 flat sides: 0.5 % of the radius
  EXPECT_NEAR(seen.x_max, 640.0 - 800.0 * std::tan(middle - half), 0.3);
}

TEST(SceneCamera, DrawsTheBodyWhereItsBoxIs) {
  const cv::Mat empty = pictureOf({}).image;
  const ScenePicture out = pictureOf({box({10, 0}, {1, 1, 2})});
  cv::Mat changed;
  cv::absdiff(out.image, empty, changed);
  cv::extractChannel(changed, changed, 1);  // green: the body has none
  const cv::Rect drawn = cv::boundingRect(changed > 60);
  EXPECT_NEAR(drawn.x, out.views[0].box.x_min, 1.5);
  EXPECT_NEAR(drawn.br().x, out.views[0].box.x_max, 1.5);
  EXPECT_NEAR(drawn.y, out.views[0].box.y_min, 1.5);
  EXPECT_NEAR(drawn.br().y, out.views[0].box.y_max, 1.5);
}

TEST(SceneCamera, ToldHowMuchIsHidden) {
  const Body wide = box({20, 0}, {1, 2, 2});
  EXPECT_EQ(pictureOf({wide, box({10, 0}, {1, 4, 4})}).views[0].visible, 0.0);
  // its left half, as seen from the camera: a wall whose right edge is on the optical axis
  EXPECT_NEAR(pictureOf({wide, box({10, 2}, {1, 4, 4})}).views[0].visible, 0.5, 0.02);
  EXPECT_EQ(pictureOf({box({10, 2}, {1, 4, 4}), wide}).views[0].visible, 1.0);
}

TEST(SceneCamera, DoesNotDrawWhatIsBehindOrBesideIt) {
  const cv::Mat empty = pictureOf({}).image;
  for (const Eigen::Vector2d& middle :
       {Eigen::Vector2d(-10, 0), Eigen::Vector2d(0.5, 0), Eigen::Vector2d(5, 50)}) {
    const ScenePicture out = pictureOf({box(middle, {1, 1, 2})});
    EXPECT_EQ(out.views[0].visible, 0.0);
    EXPECT_TRUE(same(out.image, empty));
  }
}

}  // namespace
}  // namespace field_fusion::core
