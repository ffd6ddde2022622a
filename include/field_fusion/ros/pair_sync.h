#pragma once
// Brings clusters and the detections of the same instant together.
#include <message_filters/pass_through.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/synchronizer.h>

#include <deque>
#include <memory>
#include <optional>

#include "field_fusion/ClusterArray.h"
#include "field_fusion/ImageDetectionArray.h"
#include "field_fusion/core/match/match.h"

namespace field_fusion {

/// Approximate time synchronisation (paper 001 section VI-A) that loses nothing: every ClusterArray comes out
/// once, in order of stamps, with its detections or, when they do not come in time, without. Clusters wait no
/// longer than `partner_timeout`, nor longer than until a pair with a later stamp, nor at all while the
/// camera has been silent for `partner_timeout`.
class PairSync {
 public:
  struct Pair {
    ClusterArray::ConstPtr clusters;
    ros::WallTime arrival;                     ///< of the clusters
    ImageDetectionArray::ConstPtr detections;  ///< null: none in time
  };

  /// `params` must outlive this; a change of partner_timeout holds at once.
  explicit PairSync(const core::SyncParams& params) : params_(params) { reset(); }

  /// Stamps of an input must rise. One that does not is the first of a new subscription: starts anew.
  /// False when detections found that their clusters had already gone on alone.
  bool add(const ClusterArray::ConstPtr& clusters, ros::WallTime now);
  bool add(const ImageDetectionArray::ConstPtr& detections, ros::WallTime now);

  /// The next that need wait no longer.
  std::optional<Pair> next(ros::WallTime now);

  bool empty() const { return waiting_.empty(); }
  struct Counts {
    std::uint64_t pairs = 0, alone = 0;
    std::uint64_t late = 0;  ///< detections whose clusters had already gone on alone
  };
  const Counts& counts() const { return counts_; }
  void reset();

 private:
  using Policy = message_filters::sync_policies::ApproximateTime<ClusterArray, ImageDetectionArray>;
  struct Waiting {
    Pair pair;
    bool settled = false;  // has its partner, or will have none
  };

  void onPair(const ClusterArray::ConstPtr& clusters, const ImageDetectionArray::ConstPtr& detections);
  bool expired(const Pair& pair, ros::WallTime now) const;

  const core::SyncParams& params_;
  message_filters::PassThrough<ClusterArray> clusters_in_;
  message_filters::PassThrough<ImageDetectionArray> detections_in_;
  std::unique_ptr<message_filters::Synchronizer<Policy>> sync_;  // after the inputs it hangs on
  std::deque<Waiting> waiting_;                                  // by stamp
  ros::Time last_clusters_, last_detections_;
  ros::WallTime camera_heard_;  // zero: nothing has come yet
  Counts counts_;
};

}  // namespace field_fusion
