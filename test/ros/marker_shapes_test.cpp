#include "field_fusion/ros/marker_shapes.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace field_fusion {
namespace {

double length(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

TEST(AddBox, DrawsTwelveEdgesBetweenEightCorners) {
  Points lines;
  addBox(lines, {1, 2, 3}, {2, 4, 6});
  ASSERT_EQ(lines.size(), 24u);
  std::set<std::tuple<double, double, double>> corners;
  double total = 0;
  for (std::size_t i = 0; i < lines.size(); i += 2) total += length(lines[i], lines[i + 1]);
  for (const auto& p : lines) corners.insert({p.x, p.y, p.z});
  EXPECT_EQ(corners.size(), 8u);
  EXPECT_EQ(*corners.begin(), std::make_tuple(0.0, 0.0, 0.0));
  EXPECT_EQ(*corners.rbegin(), std::make_tuple(2.0, 4.0, 6.0));
  EXPECT_DOUBLE_EQ(total, 4 * (2 + 4 + 6));
}

TEST(AddDashedLine, DashesAndGapsAreAlikeFromEndToEnd) {
  Points lines;
  addDashedLine(lines, {0, 0, 0}, {2.25, 0, 0}, 0.25);
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_EQ(lines.front().x, 0.0);
  EXPECT_NEAR(lines.back().x, 2.25, 1e-12);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) EXPECT_NEAR(lines[i + 1].x - lines[i].x, 0.25, 1e-12);
}

TEST(AddDashedLine, ShortLineIsOneDashAndLongOneIsBounded) {
  Points lines;
  addDashedLine(lines, {1, 1, 1}, {1, 1, 1}, 0.25);
  EXPECT_EQ(lines.size(), 2u);
  addDashedLine(lines, {0, 0, 0}, {1e9, 0, 0}, 0.25);
  EXPECT_LE(lines.size(), 402u);
}

TEST(AddDashedCircle, LiesOnTheCircleWithGapsAsLongAsDashes) {
  Points lines;
  addDashedCircle(lines, {1, 2, 3}, 1.5);
  double drawn = 0;
  for (std::size_t i = 0; i < lines.size(); i += 2) drawn += length(lines[i], lines[i + 1]);
  for (const auto& p : lines) {
    EXPECT_NEAR(std::hypot(p.x - 1, p.y - 2), 1.5, 1e-12);
    EXPECT_EQ(p.z, 3.0);
  }
  EXPECT_NEAR(drawn, 3.14159265 * 1.5, 0.01);
}

}  // namespace
}  // namespace field_fusion
