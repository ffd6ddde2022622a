#pragma once
// What the models of models/make_fixtures.py find a body in.
#include <sensor_msgs/Image.h>

namespace field_fusion::test {

inline sensor_msgs::Image redImage(double stamp, std::uint32_t side = 32) {
  sensor_msgs::Image image;
  image.header.frame_id = "camera_optical";
  image.header.stamp.fromSec(stamp);
  image.encoding = "rgb8";
  image.width = image.height = side;
  image.step = 3 * side;
  for (std::uint32_t i = 0; i < side * side; ++i) image.data.insert(image.data.end(), {255, 0, 0});
  return image;
}

}  // namespace field_fusion::test
