#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/detect/yolo.h"

namespace field_fusion::core {
namespace {

std::vector<Detection> suppressed(std::vector<Detection> detections, double iou, int most = 1000) {
  suppressOverlaps(detections, iou, most);
  return detections;
}

bool same(const Detection& a, const Detection& b) {
  return a.class_id == b.class_id && a.score == b.score && a.box.x_min == b.box.x_min &&
         a.box.y_min == b.box.y_min && a.box.x_max == b.box.x_max && a.box.y_max == b.box.y_max;
}

std::vector<Detection> crowd(int count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(0, 100), side(5, 40), score(0, 1);
  std::vector<Detection> made;
  for (int i = 0; i < count; ++i) {
    const float x = place(random), y = place(random);
    made.push_back({int(random() % 3), score(random), {x, y, x + side(random), y + side(random)}, 0});
  }
  return made;
}

/// By definition: again and again the best of those left survives and strikes out its like.
std::vector<Detection> bruteForce(std::vector<Detection> left, double limit) {
  std::vector<Detection> survivors;
  while (!left.empty()) {
    const auto best =
        std::max_element(left.begin(), left.end(), [](auto& a, auto& b) { return a.score < b.score; });
    const Detection winner = *best;
    survivors.push_back(winner);
    left.erase(best);
    const auto struck = [&](const Detection& other) {
      const cv::Rect2d a({winner.box.x_min, winner.box.y_min},
                         cv::Point2d(winner.box.x_max, winner.box.y_max));
      const cv::Rect2d b({other.box.x_min, other.box.y_min}, cv::Point2d(other.box.x_max, other.box.y_max));
      return other.class_id == winner.class_id &&
             (a & b).area() / (a.area() + b.area() - (a & b).area()) > limit;
    };
    left.erase(std::remove_if(left.begin(), left.end(), struck), left.end());
  }
  return survivors;
}

TEST(SuppressOverlaps, EqualsTheDefinition) {
  std::mt19937 random(3);
  for (const int count : {0, 1, 2, 10, 100, 400})
    for (const double limit : {0.0, 0.2, 0.45, 0.9, 1.0}) {
      const std::vector<Detection> made = crowd(count, random);
      const std::vector<Detection> found = suppressed(made, limit), expected = bruteForce(made, limit);
      ASSERT_EQ(found.size(), expected.size()) << count << " boxes, limit " << limit;
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(same(found[i], expected[i])) << i;
    }
}

TEST(SuppressOverlaps, DoesNotDependOnTheOrderOfItsInput) {
  std::mt19937 random(4);
  std::vector<Detection> made = crowd(200, random);
  for (Detection& d : made) d.score = std::round(d.score * 4) / 4;  // many ties
  const std::vector<Detection> expected = suppressed(made, 0.3);
  for (int i = 0; i < 10; ++i) {
    std::shuffle(made.begin(), made.end(), random);
    const std::vector<Detection> found = suppressed(made, 0.3);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same));
  }
}

TEST(SuppressOverlaps, KeepsAnOverlapExactlyAtTheLimit) {
  const std::vector<Detection> made{{0, 0.9f, {0, 0, 4, 2}, 0}, {0, 0.8f, {0, 0, 2, 2}, 0}};  // overlap 1/2
  EXPECT_EQ(suppressed(made, 0.5).size(), 2u);
  EXPECT_EQ(suppressed(made, 0.499).size(), 1u);
}

TEST(SuppressOverlaps, LeavesOtherClassesAlone) {
  const ImageBox box{0, 0, 2, 2};
  EXPECT_EQ(suppressed({{0, 0.9f, box, 0}, {1, 0.8f, box, 0}, {0, 0.7f, box, 0}}, 0.45).size(), 2u);
}

TEST(SuppressOverlaps, KeepsOneOfManyEqualBoxes) {
  EXPECT_EQ(suppressed(std::vector<Detection>(500, {0, 0.5f, {1, 1, 3, 3}, 0}), 0.45).size(), 1u);
}

TEST(SuppressOverlaps, KeepsTheBestUpToTheMost) {
  std::vector<Detection> made;
  for (int i = 0; i < 10; ++i) made.push_back({0, 0.1f * i, {10.f * i, 0, 10.f * i + 5, 5}, 0});
  const std::vector<Detection> found = suppressed(made, 0.45, 3);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_FLOAT_EQ(found[0].score, 0.9f);
  EXPECT_FLOAT_EQ(found[2].score, 0.7f);
}

TEST(IntersectionOverUnion, IsZeroWithoutSharedArea) {
  EXPECT_EQ(intersectionOverUnion({0, 0, 1, 1}, {1, 0, 2, 1}), 0.f);  // a common edge
  EXPECT_EQ(intersectionOverUnion({0, 0, 0, 0}, {0, 0, 0, 0}), 0.f);
  EXPECT_EQ(intersectionOverUnion({0, 0, kNaN, 1}, {0, 0, 1, 1}), 0.f);
  EXPECT_FLOAT_EQ(intersectionOverUnion({0, 0, 2, 2}, {1, 1, 3, 3}), 1.f / 7.f);
}

}  // namespace
}  // namespace field_fusion::core
