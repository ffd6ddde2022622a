#pragma once
// A made-up recording in KITTI's layout.
#include <opencv2/imgcodecs.hpp>

#include "support/temp_folder.h"

namespace field_fusion::test {

/// The LiDAR looks along x, the reference camera along the same line, both at one place; the colour camera
/// stands 0.06 m to the left of it: P2 = K [I | (0.06, 0, 0)].
constexpr const char* kKittiCalibration =
    "P2: 100 0 32 6 0 100 24 0 0 0 1 0\n"
    "R0_rect: 1 0 0 0 1 0 0 0 1\n"
    "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";

/// x y z intensity of each point as a .bin file has it.
inline std::string kittiBytes(std::initializer_list<float> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(float)};
}

/// Frames 000000, 000001, ... of two points and a 64 x 48 image each.
class KittiFolder : public TempFolder {
 public:
  explicit KittiFolder(int frames, bool images = true) {
    write("calib.txt", kKittiCalibration);
    for (int i = 0; i < frames; ++i) {
      const std::string name = "00000" + std::to_string(i);
      write("velodyne/" + name + ".bin", kittiBytes({10, 0, 0, 0.5f, 0, 10, 0, 0.25f}));
      if (!images) continue;
      const cv::Mat image(48, 64, CV_8UC3, cv::Scalar(10 * i, 20, 30));
      std::vector<unsigned char> bytes;
      cv::imencode(".png", image, bytes);
      write("image_2/" + name + ".png", {bytes.begin(), bytes.end()});
    }
  }
};

}  // namespace field_fusion::test
