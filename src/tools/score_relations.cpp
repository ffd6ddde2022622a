// Poses and relations between them -> errors after Kuemmerle et al. (2009).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "field_fusion/core/base/median.h"
#include "field_fusion/core/io/carmen.h"
#include "field_fusion/core/io/relations.h"
#include "progress.h"

namespace {

using namespace field_fusion;

/// A CARMEN log's lines begin with a word.
bool isCarmen(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  if (in.peek() == 0x1f || std::filesystem::is_directory(file)) return false;  // whoever reads it says what it is
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#') return std::isalpha(static_cast<unsigned char>(line[0])) != 0;
  throw std::runtime_error(file + " is empty");
}

std::vector<core::StampedPose2> scannerPoses(const std::string& file, const core::Pose2& T_pose_laser) {
  std::vector<core::StampedPose2> out;
  if (isCarmen(file))
    for (const core::CarmenScan& scan : core::readCarmen(file).scans) out.push_back({scan.stamp_ns, scan.laser});
  else
    out = core::readPoses(file);
  if (out.empty()) throw std::runtime_error(file + " has no pose");
  for (core::StampedPose2& p : out) p.pose = p.pose * T_pose_laser;
  return out;
}

void row(const char* what, const core::MeanAndDeviation& v, double unit, const char* name) {
  std::printf("%-28s %10.6f +- %10.6f %s\n", what, unit * v.mean, unit * v.deviation, name);
}

void score(const std::string& poses, const std::string& relations, const core::Pose2& T_pose_laser, const std::string& csv) {
  const core::RelationScore s = core::scoreRelations(scannerPoses(poses, T_pose_laser), core::readRelations(relations));
  if (s.translation.empty()) throw std::runtime_error("no relation of " + relations + " has both its poses in " + poses);
  const double deg = core::degrees(1.0), n = static_cast<double>(s.translation.size());
  const double mean = s.absoluteTranslation().mean, worst = *std::max_element(s.translation.begin(), s.translation.end());
  std::printf("%zu relations, %zu without a pose at one of their stamps\n", s.translation.size(), s.missing);
  row("translation", s.absoluteTranslation(), 1.0, "m");
  row("translation, squared", s.squaredTranslation(), 1.0, "m^2");
  row("rotation", s.absoluteRotation(), deg, "deg");
  row("rotation, squared", s.squaredRotation(), deg * deg, "deg^2");
  std::printf("%-28s %10.6f m (median)", "translation", core::median(s.translation));
  if (n > 1.0) std::printf(", %.6f m (mean without the worst, %.3f m)", (mean * n - worst) / (n - 1.0), worst);
  std::printf("\n");
  if (csv.empty()) return;
  std::ofstream out(csv);
  out << "translation_m,rotation_deg\n";
  for (std::size_t i = 0; i < s.translation.size(); ++i) {
    out << s.translation[i] << "," << deg * s.rotation[i] << "\n";
    showProgress(i + 1, s.translation.size(), "relations");
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + csv);
}

}  // namespace

int main(int argc, char** argv) {
  std::string poses, relations, csv;
  std::vector<double> laser{0.0, 0.0, 0.0};
  CLI::App app("Scores poses by relations between them: mean and standard deviation of the relative errors.");
  app.add_option("log", poses, "corrected CARMEN log, or lines \"stamp x y yaw\" [s m m rad]")->required();
  app.add_option("relations", relations, "lines \"from to x y z roll pitch yaw\", between poses of the scanner")->required();
  app.add_option("--laser", laser, "X Y YAW [m m deg] of the scanner in the frame of the poses")->expected(3);
  app.add_option("--csv", csv, "file to write: the errors of each relation");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const double v : laser)
      if (!std::isfinite(v)) throw std::runtime_error("--laser is not finite");
    score(poses, relations, {laser[0], laser[1], core::radians(laser[2])}, csv);
  } catch (const std::exception& e) {
    std::cerr << "score_relations: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
