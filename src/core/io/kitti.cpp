#include "field_fusion/core/io/kitti.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "field_fusion/core/io/hdl64.h"

namespace field_fusion::core {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesIn(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string names(const std::vector<fs::path>& files, const fs::path& folder) {
  return std::to_string(files.size()) + " in " + folder.string();
}

/// One file for each cloud, of the same name.
void pair(const std::vector<fs::path>& clouds, const fs::path& folder, const char* extension,
          std::vector<KittiFrame>& frames, fs::path KittiFrame::*member) {
  const std::vector<fs::path> files = filesIn(folder, extension);
  if (files.size() != clouds.size())
    throw std::runtime_error("clouds and " + std::string(extension) + " files differ in number: " +
                             names(clouds, clouds.front().parent_path()) + ", " + names(files, folder));
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    if (files[i].stem() != clouds[i].stem())
      throw std::runtime_error("no " + (folder / clouds[i].stem()).string() + extension + " for " +
                               clouds[i].string());
    frames[i].*member = files[i];
  }
}

}  // namespace

std::vector<KittiFrame> listKitti(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw std::runtime_error("no such folder: " + folder.string());
  const std::vector<fs::path> clouds = filesIn(folder / "velodyne", ".bin");
  if (clouds.empty())
    throw std::runtime_error("no frames: " + (folder / "velodyne").string() + " holds no .bin files");

  std::vector<KittiFrame> frames(clouds.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) frames[i].cloud = clouds[i];
  for (const char* images : {"image_02", "image_2"})
    if (fs::is_directory(folder / images)) pair(clouds, folder / images, ".png", frames, &KittiFrame::image);
  if (fs::is_directory(folder / "calib"))
    pair(clouds, folder / "calib", ".txt", frames, &KittiFrame::calibration);
  else
    for (KittiFrame& frame : frames) frame.calibration = folder / "calib.txt";
  return frames;
}

Cloud readKittiCloud(const fs::path& file, double turn) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  const auto size = static_cast<std::size_t>(in.tellg());
  if (size % (4 * sizeof(float)) != 0)
    throw std::runtime_error("truncated cloud: " + file.string() + " has " + std::to_string(size) +
                             " bytes, not a multiple of 16");

  std::vector<float> values(size / sizeof(float));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(size));
  if (!in) throw std::runtime_error("cannot read " + file.string());

  Cloud cloud(values.size() / 4);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Point& point = cloud[i];
    point.x = values[4 * i], point.y = values[4 * i + 1], point.z = values[4 * i + 2];
    point.intensity = values[4 * i + 3];
    const Polar direction = polar(point.position().cast<double>());
    point.ring = hdl64Ring(direction.elevation);
    point.time = turnTime(direction.azimuth, turn);
  }
  return cloud;
}

}  // namespace field_fusion::core
