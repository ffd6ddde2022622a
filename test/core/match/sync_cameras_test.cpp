// The synchroniser with several cameras, and while the LiDAR is silent.
#include <gtest/gtest.h>

#include "support/sync_probe.h"

namespace field_fusion::core {
namespace {

class SyncCamerasTest : public SyncProbe {};

TEST_F(SyncCamerasTest, EachCameraAnswersForItselfAndPartsGoOutAtTheTimeout) {
  params_.cameras = {"left", "right"};
  params_.time_offsets = {{"right", 1.0}};
  clusters(10.0, 0.0);
  detections(10.0, 0.1, 0);
  EXPECT_EQ(frames(0.1).size(), 0u);
  detections(9.01, 0.2, 1);
  EXPECT_EQ(frames(0.2).at(0).detections, (Stamps{10.0, 9.01}));
  clusters(10.1, 0.3);
  detections(10.1, 0.4, 0);
  const auto parts = frames(0.8);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].detections[0], 10.1);
  EXPECT_TRUE(std::isnan(parts[0].detections[1]));
}

TEST_F(SyncCamerasTest, SilentLidarLetsEachDetectionArrayOut) {
  clusters(10.0, 0.0), detections(10.0, 0.0);
  EXPECT_EQ(out(0.0), Stamps{10.0});
  for (int i = 1; i <= 8; ++i) {
    detections(10.0 + 0.1 * i, 0.1 * i);
    if (i >= 5) continue;
    EXPECT_EQ(out(0.1 * i), Stamps{});
  }
  const auto seen = frames(0.8);
  ASSERT_EQ(seen.size(), 8u);
  for (int i = 1; i <= 8; ++i) {
    EXPECT_FALSE(seen[i - 1].clusters);
    EXPECT_NEAR(seen[i - 1].stamp, 10.0 + 0.1 * i, 1e-9);
  }
  EXPECT_TRUE(sync().idle());
  EXPECT_EQ(sync().counts().camera_only, 8u);
}

TEST_F(SyncCamerasTest, LidarThatNeverCameIsSilentAfterTheTimeout) {
  detections(10.0, 0.0);
  EXPECT_EQ(out(0.4), Stamps{});
  EXPECT_FALSE(sync().idle());
  EXPECT_EQ(out(0.5), Stamps{10.0});
}

TEST_F(SyncCamerasTest, CamerasAloneAreBroughtTogether) {
  params_.cameras = {"left", "right"};
  std::size_t both = 0;
  for (int i = 0; i < 40; ++i) {
    detections(10.0 + 0.1 * i, 0.1 * i, 0);
    detections(10.01 + 0.1 * i, 0.1 * i, 1);
    for (const SyncOut& frame : frames(0.1 * i))
      both += std::abs(frame.detections[1] - frame.stamp - 0.01) < 1e-9;
  }
  EXPECT_GE(both, 39u);
}

TEST_F(SyncCamerasTest, ReturningLidarNeverGoesBackInTime) {
  detections(10.0, 0.0), detections(10.1, 0.6);
  EXPECT_EQ(out(0.6).size(), 2u);
  EXPECT_FALSE(clusters(10.05, 0.7)) << "older than what went out: alone, at once";
  EXPECT_TRUE(clusters(10.15, 0.8));
}

}  // namespace
}  // namespace field_fusion::core
