#include "field_fusion/ros/pair_sync.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include <vector>

namespace field_fusion {
namespace {

const ros::WallTime kStart(1000.0);
ros::WallTime at(double seconds) { return kStart + ros::WallDuration(seconds); }

template <class M>
boost::shared_ptr<const M> stamped(double stamp) {
  auto message = boost::make_shared<M>();
  message->header.stamp.fromSec(stamp);
  return message;
}

/// What came out: the stamp of the clusters, negative when they came alone.
class PairSyncTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }  // message_filters asks for the time of receipt
  void clusters(double stamp, double now) { sync_.add(stamped<ClusterArray>(stamp), at(now)); }
  void detections(double stamp, double now) { sync_.add(stamped<ImageDetectionArray>(stamp), at(now)); }
  std::vector<double> out(double now) {
    std::vector<double> stamps;
    while (const auto pair = sync_.next(at(now))) {
      const double stamp = pair->clusters->header.stamp.toSec();
      stamps.push_back(pair->detections ? stamp : -stamp);
    }
    return stamps;
  }

  core::SyncParams params_;  // partner_timeout 0.5 s, max_interval 0.05 s
  PairSync sync_{params_};
};

using Stamps = std::vector<double>;

TEST_F(PairSyncTest, EqualStampsPairAtOnceInEitherOrder) {
  clusters(10.0, 0.0);
  EXPECT_EQ(out(0.1), Stamps{});
  detections(10.0, 0.1);
  EXPECT_EQ(out(0.1), Stamps{10.0});
  detections(10.1, 0.2);
  clusters(10.1, 0.3);
  EXPECT_EQ(out(0.3), Stamps{10.1});
  EXPECT_EQ(sync_.counts().pairs, 2u);
}

TEST_F(PairSyncTest, StampsWithinTheIntervalPair) {
  clusters(10.0, 0.0);
  detections(10.01, 0.0);
  EXPECT_EQ(out(0.0), Stamps{10.0});
}

TEST_F(PairSyncTest, StampsBeyondTheIntervalNeverPair) {
  clusters(10.0, 0.0);
  detections(10.06, 0.0);
  clusters(11.0, 0.1);
  detections(11.06, 0.1);
  EXPECT_EQ(out(10.0), (Stamps{-10.0, -11.0}));
}

TEST_F(PairSyncTest, ClustersGoAloneAfterTheTimeout) {
  detections(9.9, 0.3);
  clusters(10.0, 0.4);
  EXPECT_EQ(out(0.79), Stamps{});
  EXPECT_EQ(out(0.91), Stamps{-10.0});
  EXPECT_EQ(sync_.counts().alone, 1u);
}

TEST_F(PairSyncTest, NobodyWaitsWhileTheCameraIsSilent) {
  clusters(10.0, 0.0);
  EXPECT_EQ(out(0.4), Stamps{});
  EXPECT_EQ(out(0.6), Stamps{-10.0});
  clusters(10.7, 0.7);
  EXPECT_EQ(out(0.7), Stamps{-10.7});
}

TEST_F(PairSyncTest, LaterPairSendsTheEarlierOnInOrder) {
  clusters(10.0, 0.0);
  clusters(10.1, 0.1);
  clusters(10.2, 0.2);
  detections(10.2, 0.3);
  EXPECT_EQ(out(0.3), (Stamps{-10.0, -10.1, 10.2}));
}

TEST_F(PairSyncTest, LateDetectionsAreCountedAndGoNowhere) {
  clusters(10.0, 0.0);
  EXPECT_EQ(out(0.6), Stamps{-10.0});
  detections(10.0, 0.7);
  EXPECT_EQ(out(0.7), Stamps{});
  EXPECT_EQ(sync_.counts().late, 1u);
}

TEST_F(PairSyncTest, NearestOfAFastCameraIsTaken) {
  params_.partner_timeout = 60.0;
  for (int i = 0; i < 30; ++i) {
    if (i % 3 == 0) clusters(10.0 + i / 30.0, i / 30.0);
    detections(10.01 + i / 30.0, i / 30.0);
  }
  std::size_t n = 0;
  while (const auto pair = sync_.next(at(1.0))) {
    ASSERT_TRUE(pair->detections);
    EXPECT_NEAR((pair->detections->header.stamp - pair->clusters->header.stamp).toSec(), 0.01, 1e-6);
    ++n;
  }
  EXPECT_GE(n, 9u);
}

TEST_F(PairSyncTest, StampsThatGoBackStartAnew) {
  clusters(100.0, 0.0);
  detections(100.2, 0.0);
  clusters(5.0, 0.1);
  detections(5.0, 0.1);
  EXPECT_EQ(out(0.1), Stamps{5.0});
}

TEST_F(PairSyncTest, FullQueueSendsTheOldestOn) {
  params_.partner_timeout = 3600.0;
  for (int i = 0; i <= params_.queue_size; ++i) clusters(10.0 + 0.1 * i, 0.0);
  EXPECT_EQ(out(0.0), Stamps{-10.0});
}

TEST_F(PairSyncTest, ResetForgetsWhatWaits) {
  clusters(10.0, 0.0);
  sync_.reset();
  EXPECT_TRUE(sync_.empty());
  detections(10.0, 0.1);
  EXPECT_EQ(out(9.0), Stamps{});
}

}  // namespace
}  // namespace field_fusion
