#include "field_fusion/ros/markers.h"

#include <gtest/gtest.h>

#include <set>

#include "support/obstacles.h"

namespace field_fusion {
namespace {

using test::obstacleAt;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

ObstacleArray arrayOf(const std::vector<Obstacle>& obstacles) {
  ObstacleArray out;
  out.header.frame_id = "lidar";
  out.header.stamp = ros::Time(5);
  out.obstacles = obstacles;
  return out;
}

const Marker* find(const MarkerArray& array, const std::string& ns, int action = Marker::ADD) {
  for (const auto& m : array.markers)
    if (m.ns == ns && m.action == action) return &m;
  return nullptr;
}

std::set<std::string> namespacesOf(const MarkerArray& array) {
  std::set<std::string> out;
  for (const auto& m : array.markers) out.insert(m.ns);
  return out;
}

const Obstacle kPair = obstacleAt(Obstacle::SOURCE_BOTH, 8, 0, "car");
const Obstacle kAlone = obstacleAt(Obstacle::SOURCE_LIDAR, 12, 30);
const Obstacle kSeen = obstacleAt(Obstacle::SOURCE_CAMERA, 15, -30, "person");

Obstacle directionOnly() {
  auto out = obstacleAt(Obstacle::SOURCE_CAMERA, 15, -30, "person");
  out.position.x = out.position.y = out.position.z = out.range = core::kNaN;
  return out;
}

TEST(MarkerStyle, EveryLayerHasItsOwnNameAndItsRow) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(Layer::kLabelCamera); ++i) {
    const auto& style = styleOf(static_cast<Layer>(i));
    EXPECT_EQ(static_cast<int>(style.layer), i);
    names.insert(style.name);
  }
  EXPECT_EQ(names.size(), 11u);
}

TEST(ObstacleMarkers, NothingDrawsNothing) {
  EXPECT_TRUE(ObstacleMarkers().draw(arrayOf({}))->markers.empty());
}

TEST(ObstacleMarkers, EachSourceHasItsLayers) {
  using Names = std::set<std::string>;
  EXPECT_EQ(namespacesOf(*ObstacleMarkers().draw(arrayOf({kPair}))),
            (Names{"lidar", "box", "camera", "tolerance", "pair", "label"}));
  EXPECT_EQ(namespacesOf(*ObstacleMarkers().draw(arrayOf({kAlone}))),
            (Names{"lidar_alone", "box_alone", "label_alone"}));
  EXPECT_EQ(namespacesOf(*ObstacleMarkers().draw(arrayOf({kSeen}))),
            (Names{"camera", "tolerance", "label_camera"}));
  EXPECT_EQ(namespacesOf(*ObstacleMarkers().draw(arrayOf({directionOnly()}))),
            (Names{"bearing", "label_camera"}));
}

TEST(ObstacleMarkers, FrameAndStampAreThoseOfTheObstacles) {
  const auto array = ObstacleMarkers().draw(arrayOf({kPair, kAlone, kSeen}));
  for (const auto& m : array->markers) {
    EXPECT_EQ(m.header.frame_id, "lidar");
    EXPECT_EQ(m.header.stamp, ros::Time(5));
    EXPECT_EQ(m.pose.orientation.w, 1.0);
    EXPECT_GT(m.scale.x, 0.0);
    EXPECT_GT(m.color.a, 0.f);
  }
}

TEST(ObstacleMarkers, CameraStandsWhereItsRangeAndAngleSay) {
  Obstacle pair = kPair;  // the LiDAR has it at 8 m and 0 deg
  pair.range_difference = -1.f;
  pair.azimuth_difference = static_cast<float>(core::radians(-90));
  const auto array = ObstacleMarkers().draw(arrayOf({pair}));
  const auto camera = find(*array, "camera")->points.at(0), lidar = find(*array, "lidar")->points.at(0);
  EXPECT_NEAR(camera.x, 0.0, 1e-5);
  EXPECT_NEAR(camera.y, 9.0, 1e-5);
  EXPECT_EQ(lidar.x, 8.0);
  const auto& line = find(*array, "pair")->points;
  EXPECT_NEAR(line.front().y, camera.y, 1e-9);
  EXPECT_NEAR(line.back().x, lidar.x, 1e-9);
}

TEST(ObstacleMarkers, CircleHasTheToleranceForRadius) {
  MarkersParams params;
  params.dist_tolerance = 2.5;
  ObstacleMarkers markers;
  markers.setParams(params);
  const auto array = markers.draw(arrayOf({kPair}));
  for (const auto& p : find(*array, "tolerance")->points) EXPECT_NEAR(std::hypot(p.x - 8, p.y), 2.5, 1e-5);
}

TEST(ObstacleMarkers, LabelStandsAboveTheBox) {
  const auto array = ObstacleMarkers().draw(arrayOf({kPair}));
  const auto* label = find(*array, "label");
  EXPECT_EQ(label->text, "car 0.50\n8.00 m, +0.0 deg");
  EXPECT_GT(label->pose.position.z - label->scale.z, 0.5);
}

TEST(ObstacleMarkers, OfManyThatTheLidarAloneSeesOnlyTheNearestAreLabelled) {
  MarkersParams params;
  params.label_range = 22;
  params.label_count = 3;
  ObstacleMarkers markers;
  markers.setParams(params);
  std::vector<Obstacle> many;
  for (int i = 0; i < 40; ++i) many.push_back(obstacleAt(Obstacle::SOURCE_LIDAR, 39 - i * 0.5, -40 + 2 * i));
  const auto array = markers.draw(arrayOf(many));
  std::multiset<std::string> texts;
  for (const auto& m : array->markers)
    if (m.ns == "label_alone") texts.insert(m.text.substr(0, m.text.find(' ')));
  EXPECT_EQ(texts, (std::multiset<std::string>{"19.50", "20.00", "20.50"}));
  EXPECT_EQ(find(*array, "lidar_alone")->points.size(), 40u);
}

TEST(ObstacleMarkers, WhatVanishesIsDeletedOnce) {
  ObstacleMarkers markers;
  markers.draw(arrayOf({kPair, kAlone}));
  const auto second = markers.draw(arrayOf({kPair}));
  std::set<std::string> deleted;
  for (const auto& m : second->markers)
    if (m.action == Marker::DELETE) {
      deleted.insert(m.ns);
      EXPECT_FALSE(m.header.frame_id.empty()) << "RViz drops a mark without a frame, also one that deletes";
    }
  EXPECT_EQ(deleted, (std::set<std::string>{"lidar_alone", "box_alone", "label_alone"}));
  for (const auto& m : markers.draw(arrayOf({kPair}))->markers) EXPECT_EQ(m.action, Marker::ADD);
}

TEST(ObstacleMarkers, WhatStaysKeepsItsIdAndIsNotDeleted) {
  ObstacleMarkers markers;
  const auto ids = [](const MarkerArray& array) {
    std::set<std::pair<std::string, int>> out;
    for (const auto& m : array.markers) out.insert({m.ns, m.id});
    return out;
  };
  const auto first = markers.draw(arrayOf({kPair, kAlone, kSeen}));
  const auto second = markers.draw(arrayOf({kSeen, kPair, kAlone}));
  EXPECT_EQ(ids(*first), ids(*second));
  for (const auto& m : second->markers) EXPECT_EQ(m.action, Marker::ADD);
}

TEST(ObstacleMarkers, NoMarkerHoldsANumberThatIsNotFinite) {
  auto nowhere = directionOnly();
  nowhere.azimuth = nowhere.elevation = core::kNaN;
  for (const auto& m :
       ObstacleMarkers().draw(arrayOf({kPair, kAlone, kSeen, directionOnly(), nowhere}))->markers) {
    EXPECT_TRUE(std::isfinite(m.pose.position.x + m.pose.position.y + m.pose.position.z));
    for (const auto& p : m.points) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z)) << m.ns;
  }
}

TEST(ObstacleMarkers, LabelsAreNumberedWithinTheirNamespace) {
  ObstacleMarkers markers;
  markers.draw(arrayOf({kPair}));
  const auto array =
      markers.draw(arrayOf({obstacleAt(Obstacle::SOURCE_LIDAR, 3, 20), kPair}));  // a nearer one came
  EXPECT_EQ(find(*array, "label")->id, 0);
  EXPECT_EQ(find(*array, "label_alone")->id, 0);
}

TEST(MarkersParams, DefaultsAreValid) {
  MarkersParams params;
  EXPECT_TRUE(core::declarationOf(params).faults().empty());
}

}  // namespace
}  // namespace field_fusion
