// A recording in KITTI's layout -> where the LiDAR was at each frame, for scores that need the way driven.
#include <pcl/registration/gicp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>

#include "field_fusion/core/base/median.h"
#include "field_fusion/core/cloud/voxel.h"
#include "field_fusion/core/io/kitti.h"
#include "progress.h"

namespace {

using namespace field_fusion;
using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr double kVoxel = 0.2;   // m, side of the cubes of which one point is kept
constexpr double kCoarse = 3.0;  // m, reach of the first search: a car at 110 km/h drives so far in a frame
constexpr double kFine = 0.6;    // m, of the last: what moves on its own finds no partner then
constexpr double kSettled =
    0.4;  // m, root mean square of the distances that remain; else something went wrong

PclCloud::Ptr readThinned(const std::filesystem::path& file) {
  core::Cloud thinned;
  core::Voxels().run(core::readKittiCloud(file), kVoxel, thinned);
  PclCloud::Ptr cloud(new PclCloud);
  for (const core::Point& point : thinned) cloud->push_back({point.x, point.y, point.z});
  return cloud;
}

class Registration {
 public:
  /// T_target_source, searched from `guess`. Throws std::runtime_error where the clouds do not fit.
  Eigen::Matrix4f align(const PclCloud::Ptr& source, const PclCloud::Ptr& target, Eigen::Matrix4f guess) {
    gicp_.setMaximumIterations(30);
    gicp_.setInputSource(source);
    gicp_.setInputTarget(target);
    PclCloud moved;
    for (const double reach : {kCoarse, kFine}) {
      gicp_.setMaxCorrespondenceDistance(reach);
      gicp_.align(moved, guess);
      guess = gicp_.getFinalTransformation();
    }
    const double residual = std::sqrt(gicp_.getFitnessScore(kFine * kFine));  // PCL squares what it compares
    if (!guess.allFinite() || !(residual < kSettled)) throw std::runtime_error("the clouds do not fit");
    residuals_.push_back(residual);
    return guess;
  }

  double medianResidual() const { return residuals_.empty() ? 0.0 : core::median(residuals_); }

 private:
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp_;
  std::vector<double> residuals_;  // m
};

void writeRow(std::ostream& out, const std::string& frame, const Eigen::Matrix4d& pose) {
  out << frame;
  for (int i = 0; i < 12; ++i) out << ',' << pose(i / 4, i % 4);
  out << '\n';
}

void convert(const std::string& folder, const std::string& csv) {
  const std::vector<core::KittiFrame> frames = core::listKitti(folder);
  std::ofstream out(csv);
  out.precision(9);
  out << "frame,r00,r01,r02,x,r10,r11,r12,y,r20,r21,r22,z\n";
  Registration registration;
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  Eigen::Matrix4f step = Eigen::Matrix4f::Identity();
  PclCloud::Ptr last = readThinned(frames.front().cloud);
  writeRow(out, frames.front().cloud.stem(), pose);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const PclCloud::Ptr cloud = readThinned(frames[i].cloud);
    try {
      step = registration.align(cloud, last, step);  // as the last: a car's speed hardly changes in a frame
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(frames[i].cloud.string() + " against the frame before: " + e.what());
    }
    pose = pose * step.cast<double>();
    writeRow(out, frames[i].cloud.stem(), pose);
    last = cloud;
    showProgress(i + 1, frames.size());
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + csv);
  std::cout << csv << ": " << frames.size() << " poses, " << pose.topRightCorner<3, 1>().norm()
            << " m from first to last, residual " << registration.medianResidual() << " m\n";
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder, csv;
  CLI::App app("Finds the poses of the LiDAR of a recording in KITTI's layout, frame to frame by GICP.");
  app.add_option("folder", folder, "with velodyne/ and calib.txt or calib/; frames follow in 0.1 s")
      ->required();
  app.add_option("csv", csv, "file to write: a row a frame, T_first_lidar (3x4) row by row")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    convert(folder, csv);
  } catch (const std::exception& e) {
    std::cerr << "kitti_poses: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
