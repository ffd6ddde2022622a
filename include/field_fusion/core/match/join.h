#pragma once
// Clusters that are pieces of one body, put together by the camera's box and the size of its class.
#include <vector>

#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/class_shape.h"
#include "field_fusion/core/match/gate.h"
#include "field_fusion/core/match/lidar_target.h"

namespace field_fusion::core {

/// A cage of pipes and nets falls into rings, near and far sides. Clusters that lie in one box by most of
/// their points, and together are no larger than the box's class, are one body. Boxes take their clusters in
/// turn, the smallest first, so that what stands before a cage is not part of it: first the likeliest by the
/// gate, else the one with the most points, then those nearest to it as long as all fit. A box whose class
/// has no known size takes the likeliest only. Keeps its buffers.
class Joiner {
 public:
  /// `margin` [rad]: how far a box may be off.
  void setParams(const ShapeParams& params, const Gate& gate, double margin);

  /// A joined body takes the place of its main piece; the other pieces leave the list. `points` are those of
  /// all clusters.
  void run(std::vector<LidarTarget>& bodies, const std::vector<Point>& points, const CameraView& view);

 private:
  std::vector<int> inside(const std::vector<LidarTarget>& bodies, const std::vector<Point>& points,
                          const CameraTarget& target, const Transform& T_view_lidar) const;
  int mainOf(const std::vector<int>& candidates, const std::vector<LidarTarget>& bodies,
             const CameraTarget& target, const Transform& T_view_lidar) const;
  std::vector<int> fitting(int main, std::vector<int> candidates, const std::vector<LidarTarget>& bodies,
                           const std::vector<Point>& points, double largest) const;
  void join(const std::vector<int>& group, std::vector<LidarTarget>& bodies,
            const std::vector<Point>& points);

  ShapeParams params_;
  Gate gate_;
  double margin_ = 0.0;
  OrientedBoxFitter box_fitter_;
  std::vector<char> taken_, gone_;  // of each body
};

}  // namespace field_fusion::core
