#include "field_fusion/core/sim/scene_camera.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace field_fusion::core {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;  // a flat convex face, in the base's frame

constexpr int kShift = 4;  // OpenCV draws to 1/16 px

/// Walls around an outline on the ground, then the roof; seen from outside they turn counter-clockwise.
std::vector<Polygon> prism(const std::vector<Eigen::Vector2d>& outline, double height) {
  std::vector<Polygon> faces;
  Polygon roof;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d a = outline[i], b = outline[(i + 1) % outline.size()];
    faces.push_back(
        {{a.x(), a.y(), 0.0}, {b.x(), b.y(), 0.0}, {b.x(), b.y(), height}, {a.x(), a.y(), height}});
    roof.emplace_back(a.x(), a.y(), height);
  }
  faces.push_back(roof);
  return faces;
}

std::vector<Polygon> facesOf(const Body& body, double time) {
  const Eigen::AlignedBox3d box = body.boxAt(time);
  const Eigen::Vector2d low = box.min().head<2>(), high = box.max().head<2>(),
                        centre = box.center().head<2>();
  if (body.shape == Body::Shape::kBox)
    return prism({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, box.max().z());
  constexpr int kSides = 32;
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kSides; ++i) {
    const double angle = radians(360.0 * i / kSides);
    outline.push_back(centre + 0.5 * body.size.x() * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return prism(outline, box.max().z());
}

/// Draws bodies into the image, and their numbers (from 1) into `owner`.
class Painter {
 public:
  explicit Painter(const SceneCamera& camera)
      : camera_(camera),
        T_camera_base_(camera.T_base_camera.inverse()),
        image_(camera.size, CV_8UC3),
        owner_(camera.size, CV_16U, cv::Scalar(0)) {
    drawBackground();
  }

  /// Its box, and as `visible` the area [px] that it covers in an empty image.
  View draw(const Body& body, double time, int number);

  const cv::Mat& image() const { return image_; }
  int areaOf(int number) const { return cv::countNonZero(owner_ == number); }

 private:
  void drawBackground();
  cv::Point2d project(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d p = T_camera_base_ * point;
    const Pinhole& c = camera_.pinhole;
    return {c.fx * p.x() / p.z() + c.cx, c.fy * p.y() / p.z() + c.cy};
  }

  const SceneCamera& camera_;
  const Transform T_camera_base_;
  cv::Mat image_, owner_;
};

void Painter::drawBackground() {
  const int horizon = static_cast<int>(camera_.pinhole.cy);
  for (int row = 0; row < image_.rows; ++row) {
    const double share = row < horizon ? static_cast<double>(row) / horizon
                                       : static_cast<double>(row - horizon) / (image_.rows - horizon);
    const cv::Vec3d sky(235 - 15 * (1 - share), 205 + 20 * share, 150 + 60 * share),
        ground(150 - 30 * share, 158 - 30 * share, 160 - 30 * share);
    image_.row(row).setTo(cv::Scalar(row < horizon ? sky : ground));
  }
}

View Painter::draw(const Body& body, double time, int number) {
  const Eigen::Vector3d eye = camera_.T_base_camera.translation(),
                        light = Eigen::Vector3d(-0.6, 0.5, 1.0).normalized();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  View view{{kInfinity, kInfinity, -kInfinity, -kInfinity}, 0.0};
  cv::Mat alone(camera_.size, CV_8U, cv::Scalar(0));
  for (const Polygon& face : facesOf(body, time)) {
    std::vector<cv::Point> corners;
    for (const Eigen::Vector3d& corner : face) {
      if ((T_camera_base_ * corner).z() < 0.1) return {};
      const cv::Point2d pixel = project(corner);
      view.box = {std::min(view.box.x_min, static_cast<float>(pixel.x + 0.5)),
                  std::min(view.box.y_min, static_cast<float>(pixel.y + 0.5)),
                  std::max(view.box.x_max, static_cast<float>(pixel.x + 0.5)),
                  std::max(view.box.y_max, static_cast<float>(pixel.y + 0.5))};
      corners.emplace_back(cvRound(pixel.x * (1 << kShift)), cvRound(pixel.y * (1 << kShift)));
    }
    const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[1]).normalized();
    if (normal.dot(eye - face[0]) <= 0.0) continue;  // seen from behind
    const double shade = 0.55 + 0.45 * std::max(0.0, normal.dot(light));
    cv::fillConvexPoly(image_, corners, cv::Scalar(cv::Vec3d(body.colour) * shade), cv::LINE_AA, kShift);
    cv::fillConvexPoly(owner_, corners, cv::Scalar(number), cv::LINE_8, kShift);
    cv::fillConvexPoly(alone, corners, cv::Scalar(255), cv::LINE_8, kShift);
  }
  view.visible = cv::countNonZero(alone);
  return view;
}

}  // namespace

SceneCamera::SceneCamera() {
  T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1,
      0;  // columns: the optical axes x, y, z in the base's frame
  T_base_camera.translation() << 0.1, 0.0, 1.6;
}

ScenePicture picture(const Scene& scene, double time, const SceneCamera& camera) {
  Painter painter(camera);
  const Eigen::Vector3d eye = camera.T_base_camera.translation();
  std::vector<std::size_t> far_first(scene.size());
  std::iota(far_first.begin(), far_first.end(), 0);
  std::sort(far_first.begin(), far_first.end(), [&](std::size_t a, std::size_t b) {
    return scene[a].boxAt(time).exteriorDistance(eye) > scene[b].boxAt(time).exteriorDistance(eye);
  });

  ScenePicture out;
  out.views.resize(scene.size());
  for (const std::size_t i : far_first) out.views[i] = painter.draw(scene[i], time, static_cast<int>(i) + 1);
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (out.views[i].visible > 0)
      out.views[i].visible = painter.areaOf(static_cast<int>(i) + 1) / out.views[i].visible;
  out.image = painter.image();
  return out;
}

}  // namespace field_fusion::core
