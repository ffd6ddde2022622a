// Insertion of depth frames into the voxel map beside OctoMap's own (paper 004, map B), frame by frame in
// turns. The maps are compared first: same voxels, same log-odds.
#include "../test/support/octomap_reference.h"
#include "field_fusion/core/cloud/voxel.h"
#include "field_fusion/core/sim/sensor_models.h"
#include "figure.h"

namespace {

using namespace field_fusion;
using Points = std::vector<Eigen::Vector3f>;

constexpr int kFrames = 60;
constexpr double kEvery = 0.5;  // s from frame to frame
constexpr double kRange = 5.0;  // m
const std::string kConfig = PROJECT_DIR "/config/";

struct Frame {
  Points points;  // in the world
  Eigen::Vector3f sensor;
};

/// Up to the range that the map takes in.
core::Cloud cloudOf(const core::sim::DepthImage& image) {
  core::Cloud out;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const float depth = image.metres[static_cast<std::size_t>(v) * image.width + u];
      if (!std::isfinite(depth)) continue;
      core::Point p;  // of a camera that looks along x
      p.x = depth;
      p.y = static_cast<float>((image.centre_x - u) / image.focal_length) * depth;
      p.z = static_cast<float>((image.centre_y - v) / image.focal_length) * depth;
      if (p.position().norm() <= kRange) out.push_back(p);
    }
  return out;
}

Frame placed(const core::Cloud& cloud, const core::Transform& T_world_sensor) {
  Frame out;
  for (const core::Point& p : cloud)
    out.points.push_back((T_world_sensor * p.position().cast<double>()).cast<float>());
  out.sensor = T_world_sensor.translation().cast<float>();
  return out;
}

/// The depth camera of the quadruped in its laboratory, each frame thinned to a point a voxel, and to every
/// sixth pixel.
void record(std::vector<Frame>& voxels, std::vector<Frame>& sixths, double resolution) {
  using namespace core::sim;
  const World world = loadWorld(kConfig + "worlds/quad_lab.yaml");
  Caster caster(world);
  for (const Mount& mount : world.robot.mounts) {
    if (mount.name != "depth") continue;
    DepthCamera camera(std::get<DepthCameraParams>(sensorParams(kConfig + "sensors", mount.model, {})), 1);
    const PoseAt pose = [&](double time) { return world.robot.way.pose(time) * mount.T_base_sensor; };
    core::Voxels thin;
    core::Cloud thinned;
    for (int i = 0; i < kFrames; ++i) {
      const core::Cloud cloud = cloudOf(camera.frame(caster, pose, i * kEvery));
      thin.run(cloud, resolution, thinned);
      voxels.push_back(placed(thinned, pose(i * kEvery)));
      core::Cloud sixth;
      for (std::size_t p = 0; p < cloud.size(); p += 6) sixth.push_back(cloud[p]);
      sixths.push_back(placed(sixth, pose(i * kEvery)));
    }
  }
}

/// Two maps of ours, by one thread and by all cores: CPU time of the first, time on the wall of the second,
/// beside OctoMap's.
bool measure(const std::vector<Frame>& frames, const std::string& name) {
  core::VoxelMapParams params;
  params.window = 0.0, params.max_range = kRange;
  core::VoxelMap shared(params);
  params.threads = 1;
  core::VoxelMap map(params);
  auto tree = test::octreeLike(params);
  std::vector<double> ours, ours_shared, theirs, ratios, ratios_one, points;
  for (const Frame& frame : frames) {
    const auto cloud = test::octomapCloud(frame.points);
    const auto insert = [&] {
      tree.insertPointCloud(cloud, test::octomapPoint(frame.sensor), params.max_range);
    };
    double their_cpu = 0.0;
    theirs.push_back(bench::wallMs([&] { their_cpu = bench::costMs(insert); }));
    ours.push_back(bench::costMs([&] { map.insert(frame.points, frame.sensor); }));
    ours_shared.push_back(bench::wallMs([&] { shared.insert(frame.points, frame.sensor); }));
    ratios.push_back(theirs.back() / ours_shared.back());
    ratios_one.push_back(their_cpu / ours.back());
    points.push_back(static_cast<double>(frame.points.size()));
  }
  const auto compared = test::difference(map, tree), compared_shared = test::difference(shared, tree);
  std::printf(
      "%s: %.0f points a frame (median), %zu frames; %zu voxels in the end, %zu and %zu of them different\n",
      name.c_str(), bench::median(points), frames.size(), compared.voxels, compared.different,
      compared_shared.different);
  const auto print = [&](const std::string& what, const std::vector<double>& values, const char* unit) {
    bench::print("voxel/insert_" + name + "/" + what, bench::medianFigure(values), unit);
  };
  print("cost_one_thread", ours, "ms"), print("cost", ours_shared, "ms"), print("octomap", theirs, "ms");
  print("ratio_one_thread", ratios_one, "-"), print("ratio", ratios, "-");
  print("project", bench::costs(21, [&] { map.project(); }), "ms");
  return compared.different + compared_shared.different == 0;
}

}  // namespace

int main() {
  std::vector<Frame> voxels, sixths;
  record(voxels, sixths, core::VoxelMapParams{}.resolution);
  const bool same = measure(voxels, "6k"), same_too = measure(sixths, "51k");
  if (!same || !same_too) std::fprintf(stderr, "bench_voxel: the maps differ\n");
  return same && same_too ? 0 : 1;
}
