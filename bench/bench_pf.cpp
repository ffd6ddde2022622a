// Cost of PF (paper 004, Algorithm 1): a depth image of 640 x 480 to a scan, and that with a scan of 1600
// beams to one.
#include <cstdio>

#include "../test/support/depth_room.h"
#include "../test/support/moving_scanner.h"
#include "field_fusion/core/scan/merge.h"
#include "figure.h"

namespace {

using namespace field_fusion;

constexpr int kRepeats = 301;

}  // namespace

int main() {
  test::DepthRoom room;
  room.boxes = {{Eigen::Vector3d(1.5, -0.4, 0.0), Eigen::Vector3d(1.8, 0.1, 0.3)},
                {Eigen::Vector3d(2.2, 0.2, 0.0), Eigen::Vector3d(2.5, 0.9, 0.5)}};
  const auto pixels = room.pixels<std::uint16_t>(0.001);
  const auto image = room.image(pixels);
  const auto place = room.place();
  const core::Scan lidar = test::Scanner{}.scan({}, test::steady({0, 0, 0}, {0, 0, 1}, 0.0), 0.0);
  core::Transform T_plane_lidar = core::Transform::Identity();
  T_plane_lidar.translation() << 0.05, 0.0, 0.5;
  core::DepthScanner scanner;
  core::ScanMerger merger;
  core::Scan depth;
  std::vector<double> depth_ms, merge_ms, sum_ms;
  for (int i = 0; i < kRepeats; ++i) {
    depth_ms.push_back(bench::costMs([&] { scanner.run(image, place, depth); }));
    merge_ms.push_back(bench::costMs([&] {
      merger.begin(place.plane_height);
      merger.add(lidar, T_plane_lidar);
      merger.add(depth, core::Transform::Identity());
    }));
    sum_ms.push_back(depth_ms.back() + merge_ms.back());
  }
  std::printf("%zu beams, %d x %d pixels; %zu returns merged\n", lidar.ranges.size(), image.width,
              image.height, merger.counts().merged);
  bench::print("pf/depth_scan_cost", bench::medianFigure(depth_ms), "ms");
  bench::print("pf/scan_merge_cost", bench::medianFigure(merge_ms), "ms");
  bench::print("pf/cost", bench::medianFigure(sum_ms), "ms");
  return 0;
}
