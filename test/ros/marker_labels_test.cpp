#include "field_fusion/ros/marker_labels.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "support/obstacles.h"

namespace field_fusion {
namespace {

using test::obstacleAt;

TEST(LabelText, TellsClassConfidenceRangeAndAngle) {
  EXPECT_EQ(labelText(obstacleAt(Obstacle::SOURCE_BOTH, 7.92, 1.2, "car")), "car 0.50\n7.92 m, +1.2 deg");
  EXPECT_EQ(labelText(obstacleAt(Obstacle::SOURCE_LIDAR, 12.0, -20.0)), "12.00 m, -20.0 deg");
}

TEST(LabelText, AdmitsWhatIsNotKnown) {
  auto o = obstacleAt(Obstacle::SOURCE_CAMERA, 10.0, 5.0, "boat");
  o.range = core::kNaN;
  EXPECT_EQ(labelText(o), "boat 0.50\nrange ?, +5.0 deg");
  o.azimuth = core::kNaN;
  EXPECT_EQ(labelText(o), "boat 0.50\nrange ?, angle ?");
}

TEST(LabelText, LongClassNameIsCut) {
  EXPECT_LT(labelText(obstacleAt(Obstacle::SOURCE_BOTH, 5, 0, std::string(5000, 'x'))).size(), 100u);
}

Label labelOver(const Eigen::Vector3d& top) {
  Label out;
  out.text = "car 0.50\n7.92 m, +1.2 deg";
  out.place = top;
  return out;
}

/// Two lines of letters of 0.5 m.
constexpr double kHalfHeight = 0.5;

TEST(LayOut, LabelStandsAboveItsBox) {
  std::vector<Label> labels{labelOver({10, 0, 1})};
  layOut(labels);
  EXPECT_GT(labels[0].place.z() - kHalfHeight, 1.0);
  EXPECT_LT(labels[0].place.z() - kHalfHeight, 2.0);
  EXPECT_EQ(labels[0].place.x(), 10.0);
}

TEST(LayOut, LabelsFarApartStayDown) {
  std::vector<Label> labels{labelOver({10, -10, 1}), labelOver({10, 10, 1})};
  layOut(labels);
  EXPECT_EQ(labels[0].place.z(), labels[1].place.z());
}

TEST(LayOut, NearestKeepsItsPlaceAndTheOneBehindMovesUp) {
  std::vector<Label> labels{labelOver({11, 0, 0}), labelOver({10, 0, 0})};
  layOut(labels);
  EXPECT_EQ(labels[0].place.x(), 10.0);
  const double near_top = (labels[0].place.z() + kHalfHeight - kEye.z()) / (10.0 - kEye.x());
  EXPECT_GE((labels[1].place.z() - kHalfHeight - kEye.z()) / (11.0 - kEye.x()), near_top);
}

TEST(LayOut, NoLabelCoversAnotherInTheView) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> x(3, 30), y(-15, 15), z(-1, 2);
  std::vector<Label> labels;
  for (int i = 0; i < 40; ++i) labels.push_back(labelOver({x(random), y(random), z(random)}));
  layOut(labels);
  // the text is 17 letters wide; less than 0.5 m a letter, and 0.5 m a line
  const auto covers = [](const Label& a, const Label& b) {
    const auto view = [](const Label& l) {
      const Eigen::Vector3d p = l.place - kEye;
      const double flat = p.head<2>().norm();
      return std::array<double, 4>{std::atan2(p.y(), p.x()), std::atan(0.5 * 17 * 0.25 / flat),
                                   (p.z() - kHalfHeight) / flat, (p.z() + kHalfHeight) / flat};
    };
    const auto u = view(a), v = view(b);
    return std::abs(u[0] - v[0]) < u[1] + v[1] && u[2] < v[3] && v[2] < u[3];
  };
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(covers(labels[i], labels[j])) << i << " and " << j;
}

TEST(LayOut, EndsWhereNumbersAreTooCoarseToMoveUp) {
  std::vector<Label> labels(20, labelOver({1e16, 0, 1e16}));
  layOut(labels);
  EXPECT_EQ(labels.size(), 20u);
}

TEST(LayOut, LabelsAtOnePlaceStandOneAboveTheOther) {
  std::vector<Label> labels(50, labelOver({0, 0, 0}));
  layOut(labels);
  for (std::size_t i = 1; i < labels.size(); ++i)
    EXPECT_GE(labels[i].place.z(), labels[i - 1].place.z() + 2 * kHalfHeight);
}

}  // namespace
}  // namespace field_fusion
