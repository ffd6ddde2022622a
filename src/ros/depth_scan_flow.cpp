#include "field_fusion/ros/depth_scan_flow.h"

#include "field_fusion/ros/depth_message.h"
#include "field_fusion/ros/scan_message.h"

namespace field_fusion {

void DepthScanFlow::setParams(const DepthScanStageParams& params) {
  scanner_.setParams(params.scan);
  level_.setParams(params.level);
  params_ = params;
}

core::ScanPlace DepthScanFlow::place(const std_msgs::Header& header, const TfCache& tf) {
  core::ScanPlace out;
  out.plane_height = params_.level.plane_height;
  out.T_plane_base = level_.send(header.stamp, tf);
  out.T_plane_sensor = level_.sensor(out.T_plane_base, header.stamp, header, tf);
  return out;
}

boost::shared_ptr<sensor_msgs::LaserScan> DepthScanFlow::run(const sensor_msgs::Image& image,
                                                             const CameraModel& camera, const TfCache& tf) {
  counts_ = withDepth(image, camera.pinhole(),
                      [&](const auto& depth) { return scanner_.run(depth, place(image.header, tf), scan_); });
  ran_ = true;
  return scanMessage(level_.header(image.header.stamp), scan_);
}

boost::shared_ptr<sensor_msgs::LaserScan> DepthScanFlow::run(const CloudMessage& cloud, const TfCache& tf) {
  counts_ = scanner_.run(cloud.points, place(cloud.header, tf), scan_);
  ran_ = true;
  return scanMessage(level_.header(cloud.header.stamp), scan_);
}

}  // namespace field_fusion
