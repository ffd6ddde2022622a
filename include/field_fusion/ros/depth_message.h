#pragma once
// Depth images of REP-118: millimetres (16UC1, 0: none) or metres (32FC1).
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <stdexcept>

#include "field_fusion/core/cloud/depth_scan.h"
#include "field_fusion/core/detect/bearing.h"

namespace field_fusion {

/// The pixels where they lie in the message. Throws std::runtime_error "image damaged: ..." where its size,
/// rows and data do not belong together.
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

/// use(core::DepthImage) with pixels of the message's kind. Throws likewise, and "image encoding not known:
/// ...".
template <class Use>
auto withDepth(const sensor_msgs::Image& image, const core::Pinhole& camera, const Use& use) {
  namespace encodings = sensor_msgs::image_encodings;
  if (image.encoding == encodings::TYPE_16UC1 || image.encoding == encodings::MONO16)
    return use(depthOf<std::uint16_t>(image, camera));
  if (image.encoding == encodings::TYPE_32FC1) return use(depthOf<float>(image, camera));
  throw std::runtime_error("image encoding not known: " + image.encoding + " is neither 16UC1 nor 32FC1");
}

}  // namespace field_fusion
