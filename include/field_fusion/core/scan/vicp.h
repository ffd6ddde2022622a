#pragma once
// `method: vicp` of `deskew_scan`, a rival of MDR in paper 004: its reference [14], Hong, Ko and Kim, "VICP:
// Velocity updating iterative closest point algorithm", ICRA 2010. No odometry: from scan to scan alone.
#include <memory>
#include <optional>
#include <vector>

#include "field_fusion/core/base/motion_track.h"

namespace field_fusion::core {

struct VicpParams {
  enum class Metric { kPoint, kLine };
  Metric metric = Metric::kPoint;
  double max_distance = 0.5;
  int iterations = 30;
  int updates = 10;

  void declare(Params& p) {
    p.choice("vicp_metric", metric, {"point", "line"}, When::kLive,
             "vicp: what is made least, distances to points (as published) or to the line through two.");
    p.number("vicp_max_distance", max_distance, {0.01, 10.0}, "m", When::kLive,
             "vicp: points farther apart do not belong together.");
    p.number("vicp_iterations", iterations, {1, 1000}, "", When::kLive, "vicp: most steps of one ICP.");
    p.number("vicp_updates", updates, {1, 100}, "", When::kLive, "vicp: most updates of the velocity.");
  }
};

/// Motion of a planar scanner in its own frame; it keeps it during a scan and the one before.
struct PlanarVelocity {
  double x = 0.0, y = 0.0;  ///< [m/s]
  double turn = 0.0;        ///< [rad/s]
};

class Vicp {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  explicit Vicp(const VicpParams& params = {});
  ~Vicp();
  void setParams(const VicpParams& params);

  /// The velocity with which the scan, freed of its distortion by it, lies on the one before. None for the
  /// first scan, after 0.5 s of silence, or where too little of the scans lies together.
  /// `points` of the raw scan, in its plane, with times [s] after `stamp`.
  std::optional<PlanarVelocity> run(const Cloud& points, double stamp);
  int updates() const { return updates_; }  ///< of the last run
  void reset();

 private:
  struct Model;
  void undistort(const Cloud& points);
  std::optional<Eigen::Isometry2d> icp(Eigen::Isometry2d T_before_now) const;

  VicpParams params_;
  std::unique_ptr<Model> model_;  // the scan before
  double stamp_ = 0.0;            // of it
  PlanarVelocity velocity_;
  std::vector<Eigen::Vector2d> now_;  // the points at the stamp
  int updates_ = 0;
};

/// The motion of a body in the plane that keeps its velocity for `time` [s], and back.
Eigen::Isometry2d planarMotion(const PlanarVelocity& velocity, double time);
PlanarVelocity planarVelocity(const Eigen::Isometry2d& motion, double time);

}  // namespace field_fusion::core
