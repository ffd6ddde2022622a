#pragma once
// Where in a map a scan fits best, and how well it fits around there.
#include <Eigen/Core>

#include <vector>

#include "field_fusion/core/base/pose2.h"
#include "field_fusion/core/map/field_window.h"
#include "field_fusion/core/map/slam_scan.h"

namespace field_fusion::core {

struct MatchSettings {
  double resolution = 0.05;      ///< [m] of a cell
  double sigma = 0.05;           ///< [m] of a beam's end about its wall
  double outlier = 3.0;          ///< [sigma] from which an end no longer pulls
  double effective_beams = 60.0; ///< of a scan, by which it is weighed against the odometry
};

/// What odometry says: normal, in the map's frame.
struct PosePrior {
  Pose2 mean;
  Eigen::Matrix3d covariance;  ///< of x [m], y [m], yaw [rad]
};

struct Match {
  Pose2 peak;                  ///< most likely pose
  Pose2 mean;                  ///< of the normal about it, by samples (Grisetti et al. 2007, Eqs. 15-17)
  Eigen::Matrix3d covariance;  ///< likewise, of x [m], y [m], yaw [rad]
  double log_evidence = 0.0;   ///< of scan and odometry, over all poses around the peak (Eq. 18), less a constant
  double score = 0.0;          ///< beams that end on something known; one that is nearly off counts less
};

/// Keeps its buffers from scan to scan; one for each thread.
class ScanMatcher {
 public:
  explicit ScanMatcher(const MatchSettings& settings);

  /// Of a scan with at least one hit. Computes missing fields of the map.
  Match match(const SlamScan& scan, TileMap& map, const PosePrior& prior);
  /// The most likely pose alone.
  Pose2 peak(const SlamScan& scan, TileMap& map, const PosePrior& prior);
  /// The logarithm of the likelihood of the scan at one pose, at most 0; and its score.
  double logLikelihood(const SlamScan& scan, TileMap& map, const Pose2& T_map_base, double* score = nullptr);

 private:
  using Vector = Eigen::Vector3d;  // x, y [cells of the window], yaw [rad]
  struct Normal {                  // equations of one step
    Eigen::Matrix3d information;
    Vector slope;
    double cost;
  };

  struct RoughPoint {
    int cell_x, cell_y;  // of the window
    float x, y;          // [cells] likewise
  };

  struct Hit {     // in the robot's frame
    float x, y;    // [cells]
    float nx, ny;  // normal of the scan's own wall, or 0
  };

  void open(const SlamScan& scan, TileMap& map, const Pose2& about);
  Vector inWindow(const Pose2& pose) const;
  Pose2 inMap(const Vector& v) const;
  void setPrior(const PosePrior& prior);
  double priorCost(const Vector& v) const;
  template <class... Where>
  auto missAt(const Wall& nearest, int x, int y, const Where&... where) const;
  double cost(const Vector& v, float outlier);
  Normal normal(const Vector& v, float outlier);
  Vector search(const PosePrior& prior);
  void turnRough(double yaw, std::size_t stride);
  float roughCost(int dx, int dy, float limit, float most);
  Vector descend(Vector v);
  Vector best(const PosePrior& prior);
  void sample(const Vector& peak, Match& out);

  MatchSettings settings_;
  float outlier_;               // [cells]
  FieldWindow window_;
  std::vector<Hit> hits_;
  std::vector<RoughPoint> rough_;
  double scale_ = 1.0;          // of a beam's cost
  double reach_ = 1.0;          // [cells] root mean square distance of the hits
  double score_ = 0.0;          // of the last cost
  Vector prior_mean_;
  Eigen::Matrix3d prior_information_;
};

}  // namespace field_fusion::core
