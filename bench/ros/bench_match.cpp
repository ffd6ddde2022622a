// What waiting for a partner costs, beside message_filters' ApproximateTime on the same arrivals, and the
// cost of matching 500 boxes with 500 clusters. The arrivals are a simulation: no clock, no thread, no load.
#include <message_filters/pass_through.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>

#include <boost/bind/bind.hpp>
#include <boost/make_shared.hpp>

#include <cmath>
#include <map>

#include "../../test/support/bodies.h"
#include "../figure.h"
#include "field_fusion/ClusterArray.h"
#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/core/match/match.h"

namespace {

using namespace field_fusion;

constexpr double kStart = 1000.0, kSeconds = 120.0, kMaxInterval = 0.05;
constexpr double kLidarPeriod = 0.1, kCameraPeriod = 1.0 / 30.0;
constexpr double kClusterSpacing = 0.096, kDetectionSpacing = 0.0293;  // the rival's bounds: never closer
constexpr int kSeeds = 21, kQueue = 30;

struct Arrival {
  double now, stamp;
  bool lidar;
};

/// Stamps within 2 ms of their turn. The LiDAR chain takes 15 to 30 ms, the detector 40 to 120 ms; messages
/// of one topic do not overtake one another.
std::vector<Arrival> arrivals(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.002, 0.002), lidar(0.015, 0.030), camera(0.040, 0.120);
  std::uniform_real_distribution<double> phase(0.0, kCameraPeriod);
  const double first = kStart + phase(random);
  std::vector<Arrival> out;
  const auto add = [&](double start, double period, auto& latency, bool is_lidar) {
    double last = 0.0;
    for (double turn = start; turn < kStart + kSeconds; turn += period) {
      const double stamp = turn + jitter(random);
      last = std::max(last, stamp + latency(random));
      out.push_back({last, stamp, is_lidar});
    }
  };
  add(kStart, kLidarPeriod, lidar, true);
  add(first, kCameraPeriod * 1.0007, camera, false);  // the phases drift through one another
  std::stable_sort(out.begin(), out.end(), [](const Arrival& a, const Arrival& b) { return a.now < b.now; });
  return out;
}

/// How the clusters of one stream fared.
struct Result {
  std::vector<double> added, offsets;  // [s]
  std::size_t clusters = 0;

  void pair(double now, double clusters_stamp, double detections_stamp,
            const std::map<double, double>& arrived) {
    added.push_back(now - std::max(arrived.at(clusters_stamp), arrived.at(detections_stamp)));
    offsets.push_back(std::abs(detections_stamp - clusters_stamp));
  }
  static double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
};

Result ours(const std::vector<Arrival>& stream) {
  core::SyncParams params;
  params.max_interval = kMaxInterval;
  core::Sync sync(params);
  std::map<double, double> arrived;
  Result out;
  for (const Arrival& a : stream) {
    arrived[a.stamp] = a.now;
    const auto message = boost::make_shared<double>(a.stamp);
    out.clusters += a.lidar;
    if (a.lidar)
      sync.addClusters(a.stamp, a.now, message);
    else
      sync.addDetections(0, a.stamp, a.now, message);
    while (const auto frame = sync.next(a.now))
      if (frame->answered())
        out.pair(a.now, frame->stamp, *boost::static_pointer_cast<const double>(frame->answers[0].detections),
                 arrived);
  }
  return out;
}

template <class M>
boost::shared_ptr<const M> stamped(double stamp) {
  auto message = boost::make_shared<M>();
  message->header.stamp.fromSec(stamp);
  return message;
}

Result rival(const std::vector<Arrival>& stream) {
  using Policy = message_filters::sync_policies::ApproximateTime<ClusterArray, ImageDetectionArray>;
  Policy policy(kQueue);
  policy.setMaxIntervalDuration(ros::Duration(kMaxInterval));
  policy.setInterMessageLowerBound(0, ros::Duration(kClusterSpacing));
  policy.setInterMessageLowerBound(1, ros::Duration(kDetectionSpacing));
  message_filters::PassThrough<ClusterArray> clusters;
  message_filters::PassThrough<ImageDetectionArray> detections;
  message_filters::Synchronizer<Policy> sync(std::as_const(policy), clusters, detections);
  std::map<double, double> arrived;
  Result out;
  double now = 0.0;
  const auto on_pair = [&](const ClusterArray::ConstPtr& c, const ImageDetectionArray::ConstPtr& d) {
    out.pair(now, c->header.stamp.toSec(), d->header.stamp.toSec(), arrived);
  };
  sync.registerCallback(boost::bind<void>(on_pair, boost::placeholders::_1, boost::placeholders::_2));
  for (const Arrival& a : stream) {
    now = a.now;
    out.clusters += a.lidar;
    arrived[ros::Time(a.stamp).toSec()] = now;
    if (a.lidar)
      clusters.add(stamped<ClusterArray>(a.stamp));
    else
      detections.add(stamped<ImageDetectionArray>(a.stamp));
  }
  return out;
}

void benchLatency() {
  std::printf(
      "both: max interval %.0f ms. message_filters: queue %d, inter-message lower bounds %.1f and %.1f ms, "
      "age "
      "penalty 0.1. field_fusion: the camera's spacing is learnt.\n",
      1e3 * kMaxInterval, kQueue, 1e3 * kClusterSpacing, 1e3 * kDetectionSpacing);
  std::vector<double> own, other, ratio, own_offset, other_offset, own_share, other_share;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const auto stream = arrivals(static_cast<unsigned>(seed));
    const Result a = ours(stream), b = rival(stream);
    own.push_back(1e3 * Result::mean(a.added));
    other.push_back(1e3 * Result::mean(b.added));
    ratio.push_back(other.back() / own.back());
    own_offset.push_back(1e3 * Result::mean(a.offsets));
    other_offset.push_back(1e3 * Result::mean(b.offsets));
    own_share.push_back(static_cast<double>(a.offsets.size()) / static_cast<double>(a.clusters));
    other_share.push_back(static_cast<double>(b.offsets.size()) / static_cast<double>(b.clusters));
  }
  const auto print = [](const char* name, const std::vector<double>& values, const char* unit) {
    bench::print(name, bench::medianFigure(values), unit);
  };
  print("match/mean_offset", own_offset, "ms");
  print("match/mean_offset/rival", other_offset, "ms");
  print("match/paired", own_share, "-");
  print("match/paired/rival", other_share, "-");
  std::printf("added latency: mean over all pairs, from the later partner's arrival to the output\n");
  print("match/added_latency", own, "ms");
  print("match/added_latency/rival", other, "ms");
  print("match/added_latency/ratio", ratio, "-");
}

void bench500() {
  constexpr int kBodies = 500;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> range(4.0, 60.0), azimuth(-0.7, 0.7), cost(0.0, 13.0);
  const core::Transform T_lidar_camera = test::lookingAhead({0.3, -0.2, 0.1});
  std::vector<core::Point> points;
  std::vector<core::Cluster> clusters;
  core::CameraView view = test::viewFrom(T_lidar_camera);
  for (int i = 0; i < kBodies; ++i) {
    const double r = range(random), a = azimuth(random);
    const test::Solid person = test::personAt(r * std::cos(a), r * std::sin(a));
    clusters.push_back(test::scan({person}, points, 0.2));
    view.targets.push_back(test::seenBy(T_lidar_camera, person, i, 0.05 * r));
  }
  core::Matcher matcher;
  const std::vector<std::optional<core::CameraView>> views{view};
  bench::print("match/cost_500",
               bench::medianFigure(bench::costs(41, [&] { matcher.run(clusters, points, views); })), "ms");
  std::vector<core::Candidate> all;
  for (int row = 0; row < kBodies; ++row)
    for (int column = 0; column < kBodies; ++column) all.push_back({row, column, cost(random)});
  core::Assignment assignment;
  bench::print("match/assignment_500",
               bench::medianFigure(bench::costs(41, [&] { assignment.run(kBodies, kBodies, all, 14.0); })),
               "ms");
}

}  // namespace

int main() {
  ros::Time::init();  // message_filters asks for the time of receipt
  benchLatency();
  bench500();
  return 0;
}
