#pragma once
// Clusters that several detections share, cut into one part for each.
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/gate.h"
#include "field_fusion/core/match/lidar_target.h"

namespace field_fusion::core {

struct SplitParams {
  int part_points = 5;

  void declare(Params& p) {
    p.number(
        "part_points", part_points, {1, 1000000}, "points", When::kLive,
        "optimal: fewest points of each part of a cluster that is split because several detections share "
        "it.");
  }
};

/// Two people side by side, 0.4 m apart, are one cluster and two boxes. A body is split among the boxes for
/// which it is the likeliest of all bodies. Each of its points goes to the box in whose middle it lies most,
/// in parts of the box's half width and height; what lies farther from every box than `margin` is a rest of
/// its own. The split holds when every box then has enough points and its part passes the gate, alone as it
/// is; a box that fails is left out and the others are tried again. A rest with too few points goes to the
/// nearest parts. One box alone splits a body more than twice as wide as the box, such as a wall with a
/// person before it, where the rest has points enough. Of more than 16 boxes those with the highest scores
/// are tried. What was joined by a box is not split.
///
/// Boxes that overlap by more than 30 % of the smaller are two opinions of one body (car and truck, rider and
/// bicycle): of such only the one with the highest score counts.
class Splitter {
 public:
  /// `margin` [rad]: how far a box may be off.
  void setParams(const SplitParams& params, const Gate& gate, double margin);

  /// Parts take the place of their body, in the order of the targets, a rest at last. `points` are those of
  /// all clusters.
  void run(std::vector<LidarTarget>& bodies, const std::vector<Point>& points, const CameraView& view);

 private:
  struct Part {
    const CameraTarget* target;  // null: the rest
    LidarTarget body;
  };
  void findSharers(const std::vector<LidarTarget>& bodies, const CameraView& view);
  void dropSecondOpinions(std::vector<const CameraTarget*>& boxes) const;
  bool tooWide(const LidarTarget& body, const ViewBox& box, const Transform& T_view_lidar) const;
  bool split(const LidarTarget& body, const std::vector<Point>& points, const Transform& T_view_lidar,
             std::vector<const CameraTarget*> boxes);
  void deal(const LidarTarget& body, const std::vector<Point>& points, const Transform& T_view_lidar,
            bool with_rest);
  const CameraTarget* failing(const Transform& T_view_lidar) const;

  Gate gate_;
  std::size_t part_points_ = 0;
  double margin_ = 0.0;
  OrientedBoxFitter box_fitter_;
  std::vector<std::vector<const CameraTarget*>> sharers_;  // of each body
  std::vector<Part> parts_;
  std::vector<LidarTarget> result_;
};

}  // namespace field_fusion::core
