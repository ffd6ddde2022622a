#pragma once
// From messages of depth to scans.
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>

#include "field_fusion/core/cloud/depth_scan.h"
#include "field_fusion/ros/camera_model.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/level_frame.h"

namespace field_fusion {

struct DepthScanStageParams {
  enum class Source { kImage, kPoints };
  Source source = Source::kImage;
  core::DepthScanParams scan;
  LevelParams level{"depth_plane"};

  void declare(core::Params& p) {
    p.choice("source", source, {"image", "points"}, core::When::kStart,
             "What comes in: a rectified depth image with its CameraInfo, or a cloud.");
    scan.declare(p);
    level.declare(p);
  }
};

class DepthScanFlow {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const DepthScanStageParams& params);
  bool ready(const std_msgs::Header& header, const TfCache& tf) const { return level_.ready(header, tf); }

  /// Both throw std::runtime_error where a transform is missing; the first also "image damaged: ..." and
  /// "image encoding not known: ...".
  boost::shared_ptr<sensor_msgs::LaserScan> run(const sensor_msgs::Image& image, const CameraModel& camera,
                                                const TfCache& tf);
  boost::shared_ptr<sensor_msgs::LaserScan> run(const CloudMessage& cloud, const TfCache& tf);

  const core::DepthScanCounts& counts() const { return counts_; }  ///< of the last scan
  bool blind() const { return ran_ && counts_.seen == 0; }         ///< the last image or cloud was empty

 private:
  core::ScanPlace place(const std_msgs::Header& header, const TfCache& tf);

  DepthScanStageParams params_;
  LevelFrame level_;
  core::DepthScanner scanner_;
  core::Scan scan_;
  core::DepthScanCounts counts_;
  bool ran_ = false;
};

}  // namespace field_fusion
