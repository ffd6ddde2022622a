#pragma once
// A picture as it is sent.
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "field_fusion/core/sim/camera_params.h"

namespace field_fusion::core::sim {

/// Bytes of a picture (CV_8UC3, red first), rows without gaps. kYuv422 is UYVY by ITU-R BT.601 in studio
/// range, as OpenCV and ROS read it; it needs an even width. kJpeg is a whole file. Throws
/// std::invalid_argument for another type of picture or an odd width.
std::vector<std::uint8_t> encoded(const cv::Mat& rgb, Encoding encoding, int jpeg_quality = 90);

}  // namespace field_fusion::core::sim
