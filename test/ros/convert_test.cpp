#include "field_fusion/ros/convert.h"

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include <functional>

#include "support/clouds.h"
#include "support/faults.h"
#include "support/obstacles.h"

namespace field_fusion {
namespace {

std_msgs::Header header() {
  std_msgs::Header out;
  out.stamp = ros::Time(12, 345);
  out.frame_id = "lidar";
  return out;
}

core::Clusters twoClusters() {
  const auto cloud =
      test::join({test::fillBox(50, {4, -1, 0}, {5, 0, 1}, 1), test::fillBox(50, {8, 3, 0}, {9, 4, 1}, 2)});
  return core::Clusterer().run(cloud);
}

ImageDetection detection() {
  ImageDetection out;
  out.label = "boat";
  out.score = 0.75f;
  out.ray.z = 1.0;
  out.ray_min.x = out.ray_min.y = -0.6, out.ray_min.z = std::sqrt(0.28);
  out.ray_max.x = out.ray_max.y = 0.6, out.ray_max.z = std::sqrt(0.28);
  out.range = 4.f;
  out.range_sigma = 0.5f;
  return out;
}

std::string faultIn(const ClusterArray& message) try {
  check(message);
  return "";
} catch (const std::runtime_error& e) {
  return e.what();
}

std::string faultIn(const ImageDetectionArray& message) {
  std::string fault;
  const auto sound = soundDetections(boost::make_shared<ImageDetectionArray>(message), fault);
  EXPECT_EQ(sound->detections.size(), message.detections.size() - (fault.empty() ? 0 : 1));
  return fault;
}

TEST(ClusterMessage, ComesBackAsItWas) {
  const auto clusters = twoClusters();
  ASSERT_EQ(clusters.clusters.size(), 2u);
  const auto message = clusterMessage(header(), clusters);
  EXPECT_EQ(message->header, header());
  EXPECT_EQ(faultIn(*message), "");
  const auto back = clustersOf(*message);
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto &a = clusters.clusters[i], &b = back[i];
    EXPECT_EQ(message->clusters[i].id, i);
    EXPECT_EQ(a.points.first, b.points.first);
    EXPECT_EQ(a.points.count, b.points.count);
    EXPECT_EQ(a.box.min(), b.box.min());
    EXPECT_EQ(a.box.max(), b.box.max());
    EXPECT_EQ(a.centre, b.centre);
    EXPECT_EQ(static_cast<float>(a.polar.range), b.polar.range);
    EXPECT_EQ(static_cast<float>(a.polar.azimuth), b.polar.azimuth);
    EXPECT_EQ(static_cast<float>(a.polar.elevation), b.polar.elevation);
    EXPECT_EQ(a.nearest_range, b.nearest_range);
    EXPECT_EQ(a.oriented_box.centre, b.oriented_box.centre);
    EXPECT_EQ(a.oriented_box.size, b.oriented_box.size);
    EXPECT_EQ(a.oriented_box.yaw, b.oriented_box.yaw);
  }
}

TEST(ClusterMessage, OrientedBoxMayBeUnknown) {
  auto clusters = twoClusters();
  clusters.clusters[0].oriented_box = {};
  const auto message = clusterMessage(header(), clusters);
  EXPECT_EQ(faultIn(*message), "");
  EXPECT_TRUE(std::isnan(clustersOf(*message)[0].oriented_box.yaw));
}

TEST(ClusterMessage, PointsAreThoseOfTheClusters) {
  const auto clusters = twoClusters();
  const auto message = clusterMessage(header(), clusters);
  ASSERT_EQ(message->points.size(), clusters.points.size());
  for (std::size_t i = 0; i < clusters.points.size(); ++i) {
    EXPECT_EQ(message->points[i].x, clusters.points[i].x);
    EXPECT_EQ(message->points[i].y, clusters.points[i].y);
    EXPECT_EQ(message->points[i].z, clusters.points[i].z);
  }
}

TEST(ClusterMessage, PointsComeBack) {
  const auto clusters = twoClusters();
  const auto back = pointsOf(*clusterMessage(header(), clusters));
  ASSERT_EQ(back.size(), clusters.points.size());
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_EQ(back[i].position(), clusters.points[i].position());
}

TEST(ClusterMessage, EmptyStaysEmpty) {
  const auto message = clusterMessage(header(), {});
  EXPECT_EQ(message->header, header());
  EXPECT_EQ(faultIn(*message), "");
  EXPECT_TRUE(clustersOf(*message).empty());
}

TEST(CheckClusters, NamesWhatIsWrong) {
  const auto good = clusterMessage(header(), twoClusters());
  const auto faultAfter = [&](const std::function<void(ClusterArray&)>& damage) {
    ClusterArray message = *good;
    damage(message);
    return faultIn(message);
  };
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[1].id = 7; }),
            "clusters damaged: number 1 has an id that is not its place");
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[0].centre.y = NAN; }),
            "clusters damaged: number 0 is not finite");
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[0].range = INFINITY; }),
            "clusters damaged: number 0 has a range or angle that is impossible");
  EXPECT_EQ(faultAfter([](auto& m) { std::swap(m.clusters[0].min, m.clusters[0].max); }),
            "clusters damaged: number 0 has a box with min above max");
  const std::string box =
      "clusters damaged: number 0 has an oriented box that is half known, inside out or wider than long";
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[0].box_yaw = NAN; }), box);
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[0].box_centre.x = INFINITY; }), box);
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[0].box_size.y = 99.0; }), box);
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[0].box_size.z = -1.0; }), box);
  const std::string points = "clusters damaged: number 1 names points that are not there";
  EXPECT_EQ(faultAfter([](auto& m) { m.points.pop_back(); }), points);
  EXPECT_EQ(faultAfter([](auto& m) { m.clusters[1].point_count = 0xffffffff; }), points);
}

TEST(CheckObstacles, RefusesTheImpossibleAndLetsTheUnknownPass) {
  const auto faultAfter = [](auto damage) {
    ObstacleArray array;
    array.obstacles.push_back(test::obstacleAt(Obstacle::SOURCE_LIDAR, 5.0, 10.0));
    damage(array.obstacles[0]);
    return test::faultOf([&] { check(array); });
  };
  EXPECT_EQ(faultAfter([](Obstacle&) {}), "");
  EXPECT_EQ(faultAfter([](Obstacle& o) {
              o.position.x = o.position.y = o.position.z = o.range = core::kNaN;
              o.size.x = o.size.y = o.size.z = core::kNaN;
            }),
            "");
  EXPECT_TRUE(test::says(faultAfter([](Obstacle& o) { o.position.y = core::kNaN; }), "position"));
  EXPECT_TRUE(test::says(faultAfter([](Obstacle& o) { o.position.x = INFINITY; }), "position"));
  EXPECT_TRUE(test::says(faultAfter([](Obstacle& o) { o.size.z = -1.0; }), "size"));
  EXPECT_TRUE(test::says(faultAfter([](Obstacle& o) { o.face.z = core::kNaN; }), "face"));
  EXPECT_EQ(faultAfter([](Obstacle& o) { o.face.x = o.face.y = o.face.z = core::kNaN; }), "");
  EXPECT_TRUE(test::says(faultAfter([](Obstacle& o) { o.range = -1.f; }), "range"));
  EXPECT_TRUE(test::says(faultAfter([](Obstacle& o) { o.azimuth_difference = INFINITY; }), "difference"));
}

TEST(CheckDetections, NamesWhatIsWrongAndLetsTheUnknownPass) {
  const auto faultAfter = [&](const std::function<void(ImageDetection&)>& damage) {
    ImageDetectionArray message;
    message.detections = {detection()};
    damage(message.detections[0]);
    return faultIn(message);
  };
  EXPECT_EQ(faultAfter([](auto&) {}), "");
  EXPECT_EQ(faultAfter([](auto& d) { d.range = d.range_sigma = core::kNaN; }), "");
  EXPECT_EQ(faultAfter([](auto& d) { d.ray.x = d.ray.y = d.ray.z = NAN; }), "");
  EXPECT_EQ(faultAfter([](auto& d) { d.id = 3; }),
            "detections damaged: number 0 has an id that is not its place");
  EXPECT_EQ(faultAfter([](auto& d) { d.score = NAN; }),
            "detections damaged: number 0 has a score outside 0..1");
  EXPECT_EQ(faultAfter([](auto& d) { d.score = 1.5f; }),
            "detections damaged: number 0 has a score outside 0..1");
  EXPECT_EQ(faultAfter([](auto& d) { d.range = -1.f; }),
            "detections damaged: number 0 has a negative or infinite range");
  const std::string ray = "detections damaged: number 0 has a ray that is no unit vector";
  EXPECT_EQ(faultAfter([](auto& d) { d.ray.z = 0.5; }), ray);
  EXPECT_EQ(faultAfter([](auto& d) { d.ray_max.z = 0.0; }), ray);
}

TEST(CheckDetections, OneThatIsDamagedLeavesTheOthers) {
  ImageDetectionArray message;
  message.detections = {detection(), detection(), detection()};
  for (std::uint32_t i = 0; i < 3; ++i) message.detections[i].id = i;
  message.detections[1].score = NAN;
  std::string fault;
  const auto sound = soundDetections(boost::make_shared<ImageDetectionArray>(message), fault);
  EXPECT_EQ(fault, "detections damaged: number 1 has a score outside 0..1");
  ASSERT_EQ(sound->detections.size(), 2u);
  EXPECT_EQ(sound->detections[0].id, 0u);
  EXPECT_EQ(sound->detections[1].id, 2u);
}

TEST(CheckDetections, BoxMustBeInTheImage) {
  const auto faultWith = [](float x_min, float x_max) {
    ImageDetectionArray message;
    message.width = 640, message.height = 480;
    message.detections = {detection()};
    auto& d = message.detections[0];
    d.x_min = x_min, d.x_max = x_max, d.y_min = 10.f, d.y_max = 20.f;
    return faultIn(message);
  };
  const std::string box =
      "detections damaged: number 0 has a box that is inside out, not finite or outside the image";
  EXPECT_EQ(faultWith(630.f, 650.f), "") << "reaches beyond it";
  EXPECT_EQ(faultWith(641.f, 650.f), box);
  EXPECT_EQ(faultWith(-9.f, -1.f), box);
  EXPECT_EQ(faultWith(9.f, 8.f), box);
  EXPECT_EQ(faultWith(NAN, 8.f), box);
  EXPECT_EQ(faultWith(0.f, INFINITY), box);
}

TEST(CameraTargets, AreCarriedByTheTransform) {
  ImageDetectionArray message;
  message.detections = {detection()};
  const core::Transform T_lidar_camera(Eigen::Translation3d(1, 2, 3));
  const auto view = cameraViewOf(message, &T_lidar_camera);
  const auto& targets = view.targets;
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].label, "boat");
  EXPECT_EQ(targets[0].score, 0.75);
  EXPECT_EQ(targets[0].range_sigma, 0.5);
  EXPECT_TRUE(targets[0].position.isApprox(Eigen::Vector3d(1, 2, 7)));
  EXPECT_TRUE((view.T_view_lidar * targets[0].position).isApprox(Eigen::Vector3d(4, 0, 0)));
  EXPECT_NEAR(targets[0].box.left, 0.6 / std::sqrt(0.28), 1e-9);
  EXPECT_NEAR(targets[0].box.bottom, -0.6 / std::sqrt(0.28), 1e-9);
}

TEST(CameraTargets, WithoutTransformHaveNoPlace) {
  ImageDetectionArray message;
  message.detections = {detection()};
  const auto targets = cameraViewOf(message, nullptr).targets;
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_TRUE(std::isnan(targets[0].polar.azimuth));
  EXPECT_TRUE(std::isnan(targets[0].seen.azimuth));
  EXPECT_TRUE(targets[0].position.array().isNaN().all());
}

TEST(ObstacleMessage, CarriesEveryField) {
  core::Obstacle in;
  in.cluster = 3, in.part = 2, in.camera = 1, in.detection = 4, in.source = core::ObstacleSource::kBoth;
  in.position = {1, 2, 3}, in.size = {4, 5, 6}, in.face = {0.5, 1.5, 2.5};
  in.joined = {5, 8};
  in.covariance << 1, 2, 3, 2, 5, 6, 3, 6, 9;
  in.existence = 0.5, in.label = "boat", in.label_probability = 0.25;
  in.polar = {7, 0.5, -0.5};
  in.verdict = {9, core::MatchReason::kMatched, 0.125, -0.25, 1.5};
  const auto message = obstacleMessage(header(), 1, true, {in, in});
  EXPECT_EQ(message->header, header());
  EXPECT_EQ(message->revision, 1);
  EXPECT_TRUE(message->provisional);
  ASSERT_EQ(message->obstacles.size(), 2u);
  const auto& o = message->obstacles[1];
  EXPECT_EQ(o.id, 1u);
  EXPECT_EQ(o.cluster_id, 3);
  EXPECT_EQ(o.part, 2);
  EXPECT_EQ(o.camera, 1);
  EXPECT_EQ(o.detection_id, 4);
  EXPECT_EQ(o.source, Obstacle::SOURCE_BOTH);
  EXPECT_EQ(o.position.y, 2.0);
  EXPECT_EQ(o.size.z, 6.0);
  EXPECT_EQ(o.face.y, 1.5);
  EXPECT_EQ(o.joined_clusters, (std::vector<std::uint32_t>{5, 8}));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_EQ(o.position_covariance[3 * row + column], in.covariance(row, column));
  EXPECT_EQ(o.existence, 0.5f);
  EXPECT_EQ(o.label, "boat");
  EXPECT_EQ(o.label_probability, 0.25f);
  EXPECT_EQ(o.range, 7.f);
  EXPECT_EQ(o.azimuth, 0.5f);
  EXPECT_EQ(o.elevation, -0.5f);
  EXPECT_EQ(o.reason, Obstacle::MATCHED);
  EXPECT_EQ(o.range_difference, 0.125f);
  EXPECT_EQ(o.azimuth_difference, -0.25f);
  EXPECT_EQ(o.distance, 1.5f);
}

// core spells the codes of the message once more, because it may not include it
TEST(ObstacleMessage, CodesAreThoseOfCore) {
  const auto code = [](auto value) { return static_cast<std::uint8_t>(value); };
  EXPECT_EQ(code(core::ObstacleSource::kLidar), Obstacle::SOURCE_LIDAR);
  EXPECT_EQ(code(core::ObstacleSource::kCamera), Obstacle::SOURCE_CAMERA);
  EXPECT_EQ(code(core::ObstacleSource::kBoth), Obstacle::SOURCE_BOTH);
  EXPECT_EQ(code(core::MatchReason::kNoCandidate), Obstacle::NO_CANDIDATE);
  EXPECT_EQ(code(core::MatchReason::kRangeDiffers), Obstacle::RANGE_DIFFERS);
  EXPECT_EQ(code(core::MatchReason::kAzimuthDiffers), Obstacle::AZIMUTH_DIFFERS);
  EXPECT_EQ(code(core::MatchReason::kTaken), Obstacle::TAKEN);
  EXPECT_EQ(code(core::MatchReason::kRangeUnknown), Obstacle::RANGE_UNKNOWN);
  EXPECT_EQ(code(core::MatchReason::kNoBearing), Obstacle::NO_BEARING);
  EXPECT_EQ(code(core::MatchReason::kNoPartnerMessage), Obstacle::NO_PARTNER_MESSAGE);
  EXPECT_EQ(code(core::MatchReason::kElevationDiffers), Obstacle::ELEVATION_DIFFERS);
}

}  // namespace
}  // namespace field_fusion
