#include "field_fusion/ros/depth_scan_flow.h"

#include <sensor_msgs/image_encodings.h>

#include <stdexcept>

#include "field_fusion/ros/scan_message.h"

namespace field_fusion {
namespace {

template <class Pixel>
core::DepthImage<Pixel> depthOf(const sensor_msgs::Image& image, const core::Pinhole& camera) {
  const auto fail = [&](const std::string& what) { throw std::runtime_error("image damaged: " + what); };
  const std::uint64_t least = std::uint64_t{image.width} * sizeof(Pixel);
  if (image.step < least || image.step % sizeof(Pixel) != 0)
    fail(std::to_string(image.width) + " pixels in rows of " + std::to_string(image.step) + " bytes");
  if (image.data.size() < std::uint64_t{image.step} * image.height)
    fail(std::to_string(image.data.size()) + " bytes for " + std::to_string(image.height) + " rows of " +
         std::to_string(image.step));
  if (image.is_bigendian) fail("big-endian");
  core::DepthImage<Pixel> out;
  out.width = static_cast<int>(image.width), out.height = static_cast<int>(image.height);
  out.pixels = reinterpret_cast<const Pixel*>(image.data.data());  // a vector's memory is aligned for it
  out.row = image.step / sizeof(Pixel);
  out.fx = camera.fx, out.fy = camera.fy, out.cx = camera.cx, out.cy = camera.cy;
  return out;
}

}  // namespace

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
  namespace encodings = sensor_msgs::image_encodings;
  const bool millimetres = image.encoding == encodings::TYPE_16UC1 || image.encoding == encodings::MONO16;
  if (!millimetres && image.encoding != encodings::TYPE_32FC1)
    throw std::runtime_error("image encoding not known: " + image.encoding + " is neither 16UC1 nor 32FC1");
  const auto pinhole = camera.pinhole();
  if (millimetres) {
    const auto depth = depthOf<std::uint16_t>(image, pinhole);
    counts_ = scanner_.run(depth, place(image.header, tf), scan_);
  } else {
    const auto depth = depthOf<float>(image, pinhole);
    counts_ = scanner_.run(depth, place(image.header, tf), scan_);
  }
  return scanMessage(level_.header(image.header.stamp), scan_);
}

boost::shared_ptr<sensor_msgs::LaserScan> DepthScanFlow::run(const CloudMessage& cloud, const TfCache& tf) {
  counts_ = scanner_.run(cloud.points, place(cloud.header, tf), scan_);
  return scanMessage(level_.header(cloud.header.stamp), scan_);
}

}  // namespace field_fusion
