#pragma once
// Images of the simulator as messages.
#include <sensor_msgs/Image.h>
#include <boost/make_shared.hpp>

#include <cstring>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

namespace field_fusion {

/// Rows without gaps; as many bytes a pixel as `values` has.
template <class T>
boost::shared_ptr<sensor_msgs::Image> imageMessage(const std_msgs::Header& header, const char* encoding,
                                                   cv::Size size, const std::vector<T>& values) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->header = header;
  image->encoding = encoding;
  image->width = static_cast<std::uint32_t>(size.width);
  image->height = static_cast<std::uint32_t>(size.height);
  const std::size_t bytes = values.size() * sizeof(T);
  image->step = static_cast<std::uint32_t>(bytes / image->height);
  image->data.resize(bytes);
  std::memcpy(image->data.data(), values.data(), bytes);
  return image;
}

/// Which body each pixel shows: its place in the world + 1; 0 for ground, sky and the robot.
inline std::vector<std::uint16_t> labelsOf(const int* bodies, std::size_t count) {
  std::vector<std::uint16_t> labels(count);
  for (std::size_t i = 0; i < count; ++i)
    labels[i] = bodies[i] < 0 ? std::uint16_t{0} : static_cast<std::uint16_t>(bodies[i] + 1);
  return labels;
}

}  // namespace field_fusion
