#pragma once
// Brings the clusters of one LiDAR and the detections of some cameras together by their stamps.
#include <boost/shared_ptr.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"

namespace field_fusion::core {

struct SyncParams {
  std::vector<std::string> cameras;
  double time_offset = 0.0;
  Table time_offsets;
  double max_interval = 0.05;
  double partner_timeout = 0.5;

  void declare(Params& p);
  std::size_t cameraCount() const { return cameras.empty() ? 1 : cameras.size(); }
  std::string topicOf(std::size_t camera) const;
  double offsetOf(std::size_t camera) const;  ///< [s] added to the camera's stamps
};

/// The least time between messages of one sensor, learnt from the last few.
class Spacing {
 public:
  void add(double gap);
  double least() const;  ///< [s]; 0 until enough is known
 private:
  static constexpr int kKept = 16, kEnough = 4;
  std::array<double, kKept> gaps_{};
  int count_ = 0, next_ = 0;
};

/// For each cluster array and camera the detection array that is nearest in corrected time, no farther than
/// `max_interval`; decided as soon as no later one can be nearer, or near enough: when one with a stamp not
/// before the clusters' has come, or the camera's least spacing tells that the next will lie farther off, or
/// nearer by no more than a tenth of `max_interval`, which is not worth a period of the camera.
/// Nobody waits longer than `partner_timeout`, nor for a camera that is silent: for so long, and for one and a half
/// of its own periods, so that a slow sensor is not silent between two of its messages. Every
/// cluster array that waits comes out once, in the order of stamps, with those cameras that answered.
///
/// While the LiDAR is silent, the detections of the first camera that is not are what the others are brought
/// to, and come out without clusters.
///
/// Stamps and wall times are in seconds; every call is given the wall time. Keeps no clock of its own.
class Sync {
 public:
  using Message = boost::shared_ptr<const void>;  ///< handed back as it came

  struct Answer {
    Message detections;  ///< null: none near enough in time
    /// [s] Corrected stamp of the nearest, near enough or not, minus the frame's; NaN: that is still to come.
    double offset = kNaN;
  };
  struct Frame {
    double stamp = kNaN;
    double arrival = kNaN;        ///< wall time
    Message clusters;             ///< null: the LiDAR is silent
    int leader = -1;              ///< the camera whose stamp this is; -1: the LiDAR's
    std::vector<Answer> answers;  ///< of each camera
    bool answered() const;
  };
  struct Counts {
    std::uint64_t pairs = 0, alone = 0, camera_only = 0;  ///< frames; alone: without any camera
    std::uint64_t late = 0;     ///< detections whose clusters had already gone on without them
    std::uint64_t dropped = 0;  ///< cut short because too many waited
  };

  /// `params` must outlive this; a live change holds at once.
  explicit Sync(const SyncParams& params) : params_(params) { reset(); }

  /// Stamps of each input must rise. One that does not is the first of a new subscription: starts anew.
  /// False: no camera will have a say, and `next` will not bring these clusters.
  bool addClusters(double stamp, double now, const Message& clusters);
  /// `stamp` as it came. False: clusters that these belong to have already gone on without them.
  bool addDetections(std::size_t camera, double stamp, double now, const Message& detections);

  /// The next that need wait no longer.
  std::optional<Frame> next(double now);

  bool idle() const;  ///< time alone brings nothing
  const Counts& counts() const { return counts_; }
  void reset();

 private:
  struct Item {
    double stamp, arrival;
    Message message;
  };
  struct Heard {
    double at = kNaN;  // wall time; NaN: not yet
    Spacing arrivals;
    void add(double now);
  };
  struct Camera {
    std::deque<Item> items;  // by stamp
    Spacing spacing;         // of stamps
    Heard heard;
    std::deque<double> unanswered;  // stamps that went on without this camera
  };
  struct Waiting {
    Item first;  // clusters, or the leader's detections
    int leader;
  };
  static constexpr std::size_t kQueue = 64;
  static constexpr double kMemory = 1.0;    // [s]
  static constexpr double kSlack = 0.1;     // of max_interval
  static constexpr double kPatience = 1.5;  // periods of a sensor

  void hear(double now);
  bool silent(const Heard& heard, double now) const;
  bool settled(const Camera& camera, double stamp, double now) const;
  bool ready(const Waiting& waiting, double now) const;
  void lead(double now);
  Answer nearest(const Camera& camera, double stamp) const;
  Frame release();
  void forget(double stamp);

  const SyncParams& params_;
  std::vector<Camera> cameras_;
  std::deque<Waiting> waiting_;  // by stamp
  double start_ = kNaN;          // wall time of the first message
  Heard lidar_heard_;
  double last_clusters_, released_;  // stamps
  Counts counts_;
};

}  // namespace field_fusion::core
