#include "field_fusion/core/io/map_file.h"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/io/replace_file.h"

namespace field_fusion::core {
namespace {

namespace fs = std::filesystem;

/// As map_saver draws: 0 a wall, 254 free, 205 unknown. The first row is that of the largest y.
void writePicture(std::ostream& out, const Occupancy& map) {
  out << "P5\n" << map.width << " " << map.height << "\n255\n";
  std::string row(static_cast<std::size_t>(map.width), '\0');
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) {
      const std::int8_t cell = map.cells[static_cast<std::size_t>(y) * map.width + x];
      row[x] = static_cast<char>(cell < 0 ? 205 : cell < 50 ? 254 : 0);
    }
    out << row;
  }
}

struct Meaning {
  std::string image;
  double resolution, x, y, occupied, free;
  bool negate;
};

Meaning readMeaning(const fs::path& file) {
  const YAML::Node node = YAML::LoadFile(file.string());
  for (const char* key : {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"})
    if (!node[key]) throw std::runtime_error(std::string("no ") + key);
  if (const auto mode = node["mode"]; mode && mode.as<std::string>() != "trinary")
    throw std::runtime_error("mode is " + mode.as<std::string>() + "; trinary is read");
  const auto origin = node["origin"].as<std::vector<double>>();
  if (origin.size() != 3) throw std::runtime_error("origin is not [x, y, yaw]");
  if (origin[2] != 0.0) throw std::runtime_error("the map is turned: yaw of its origin is " + floatText(origin[2]));
  Meaning out = {node["image"].as<std::string>(), node["resolution"].as<double>(), origin[0], origin[1],
                 node["occupied_thresh"].as<double>(), node["free_thresh"].as<double>(), node["negate"].as<int>() != 0};
  if (!(out.resolution > 0.0 && std::isfinite(out.resolution + out.x + out.y)))
    throw std::runtime_error("resolution or origin is no length");
  if (!(out.free >= 0.0 && out.free <= out.occupied && out.occupied <= 1.0))  // so written, NaN is a fault
    throw std::runtime_error("free_thresh and occupied_thresh are not 0 <= free <= occupied <= 1");
  return out;
}

Occupancy readPicture(const fs::path& file, const Meaning& m) {
  const cv::Mat picture = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (picture.empty()) throw std::runtime_error("cannot read image " + file.string());
  Occupancy out = {m.resolution, m.x, m.y, picture.cols, picture.rows, {}};
  for (int y = picture.rows - 1; y >= 0; --y)
    for (int x = 0; x < picture.cols; ++x) {
      const double white = picture.at<unsigned char>(y, x) / 255.0, wall = m.negate ? white : 1.0 - white;
      out.cells.push_back(wall > m.occupied ? kWallCell : wall < m.free ? kFreeCell : kUnknownCell);
    }
  return out;
}

/// In quotes where YAML would read something else.
std::string yamlText(const std::string& text) {
  YAML::Emitter out;
  out << text;
  return out.c_str();
}

}  // namespace

void writeMap(const fs::path& yaml, const Occupancy& map) {
  if (yaml.extension() != ".yaml") throw std::runtime_error("a map's name ends in .yaml: '" + yaml.string() + "'");
  if (map.cells.empty()) throw std::runtime_error("there is no map yet");
  const fs::path picture = fs::path(yaml).replace_extension(".pgm");
  if (fs::is_directory(yaml)) throw std::runtime_error("cannot write " + yaml.string() + ": it is a folder");
  replaceFile(picture, [&](std::ostream& out) { writePicture(out, map); });
  replaceFile(yaml, [&](std::ostream& out) {
    out << "image: " << yamlText(picture.filename().string()) << "\nresolution: " << floatText(map.resolution) << "\norigin: ["
        << floatText(map.x) << ", " << floatText(map.y) << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  });
}

Occupancy readMap(const fs::path& yaml) try {
  const Meaning meaning = readMeaning(yaml);
  return readPicture(yaml.parent_path() / meaning.image, meaning);
} catch (const std::exception& e) {
  throw std::runtime_error("map " + yaml.string() + ": " + e.what());
}

}  // namespace field_fusion::core
