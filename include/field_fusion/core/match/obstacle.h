#pragma once
// What is known of one body once LiDAR and camera have had their say.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/match/camera_target.h"
#include "field_fusion/core/match/lidar_target.h"
#include "field_fusion/core/match/outline.h"
#include "field_fusion/core/match/verdict.h"

namespace field_fusion::core {

struct ObstacleParams {
  double lidar_range_sigma = 0.03;
  double bearing_sigma = 0.5;
  double lidar_existence = 0.7;
  double camera_existence = 0.9;
  double faint_existence = 0.2;

  void declare(Params& p) {
    p.number("lidar_range_sigma", lidar_range_sigma, {0.001, 10.0}, "m", When::kLive,
             "Standard deviation of the LiDAR's range.");
    p.number("bearing_sigma", bearing_sigma, {0.001, 45.0}, "deg", When::kLive,
             "Standard deviation of the direction of a detection, calibration included.");
    p.number("lidar_existence", lidar_existence, {0.0, 1.0}, "", When::kLive,
             "Probability that a cluster is a body.");
    p.number("faint_existence", faint_existence, {0.0, 1.0}, "", When::kLive,
             "Probability that a faint cluster is a body, before a camera has its say.");
    p.number("camera_existence", camera_existence, {0.0, 1.0}, "", When::kLive,
             "Probability that a detection of score 1 is a body; in proportion for lower scores.");
  }
};

/// Values are those of msg/Obstacle.msg.
enum class ObstacleSource : std::uint8_t { kLidar = 1, kCamera = 2, kBoth = 3 };

/// In the LiDAR's frame. A number that is not known is NaN.
struct Obstacle {
  int cluster = -1;    ///< place of the cluster, -1: none
  int part = 0;        ///< of the cluster; 0: the whole, 1, 2, ...: a part
  std::vector<int> joined;  ///< places of further clusters that belong to it
  int camera = -1;     ///< place of the camera that the detection is of, -1: none
  int detection = -1;  ///< CameraTarget::id, -1: none
  ObstacleSource source = ObstacleSource::kLidar;
  Eigen::Vector3d position;         ///< [m] centre of the body
  Eigen::Matrix3d covariance;       ///< [m^2] of position; symmetric and positive definite, or all NaN
  Eigen::Vector3d size;             ///< [m] axis-aligned extent
  Eigen::Vector3d face;             ///< [m] its point that is nearest to the LiDAR
  double existence = 0.0;           ///< 0..1
  std::string label;                ///< class, empty: unknown
  double label_probability = kNaN;  ///< 0..1
  Polar polar;                      ///< of the position; without range, the direction alone
  Verdict verdict;                  ///< Verdict::partner has no meaning here
};

/// What the LiDAR alone knows. The body's centre may lie anywhere in the cluster's box alike (a variance of
/// extent^2 / 12 along each axis), and the range has its noise, taken for every direction.
Obstacle lidarObstacle(const LidarTarget& body, const Verdict& verdict, const ObstacleParams& params);

/// What the camera alone knows. Position and covariance are NaN where the range is: the error of the range
/// lies along the ray, that of the bearing across.
Obstacle cameraObstacle(int camera, const CameraTarget& target, const Verdict& verdict,
                        const ObstacleParams& params);

/// A matched pair: position, size, range and azimuth from the LiDAR, the class from the camera (paper 001
/// section VI). The two exist independently of one another: 1 - (1 - p)(1 - q).
Obstacle matchedObstacle(const LidarTarget& body, int camera, const CameraTarget& target,
                         const Verdict& verdict, const ObstacleParams& params);

/// Puts the whole body in the place of what is seen of it.
void complete(Obstacle& obstacle, const Outline& outline);

}  // namespace field_fusion::core
