// A CARMEN log -> a bag with scans, odometry and transforms.
#include <nav_msgs/Odometry.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "field_fusion/core/io/carmen.h"
#include "field_fusion/ros/recording.h"
#include "field_fusion/ros/scan_message.h"
#include "progress.h"
#include "within.h"

namespace {

using namespace field_fusion;

struct Options {
  std::string log, bag;
  std::vector<double> laser;  // x, y [m], yaw [deg] of the scanner on the robot; empty: as the log says
  double max_range = 80.0;    // m, for logs that do not say
  double start = 0.0;         // s, added to every stamp
  bool logger_stamps = false;
};

struct Line {
  std::int64_t stamp_ns;
  core::Pose2 odometry;
  const core::CarmenScan* scan;  // null: odometry alone
};

/// T_base_laser. Throws where the log's own does not stay the same: the poses are corrected ones, then.
core::Pose2 laserPlace(const Options& o, const core::CarmenLog& log) {
  if (!o.laser.empty()) return {o.laser[0], o.laser[1], core::radians(o.laser[2])};
  const auto place = [](const core::CarmenScan& s) { return core::between(s.odometry, s.laser); };
  const core::Pose2 first = place(log.scans.front());
  for (const core::CarmenScan& scan : log.scans) {
    const core::Pose2 off = core::between(first, place(scan));
    if (off.position().norm() > 0.005 || std::abs(off.yaw) > 0.005)
      throw std::runtime_error(o.log + ": the scanner's place on the robot is not the same all the time; tell it by --laser X Y YAW");
  }
  return first;
}

std::vector<Line> linesOf(const core::CarmenLog& log) {
  std::vector<Line> out;
  for (const auto& odometry : log.odometry) out.push_back({odometry.stamp_ns, odometry.pose, nullptr});
  for (const auto& scan : log.scans) out.push_back({scan.stamp_ns, scan.odometry, &scan});
  std::stable_sort(out.begin(), out.end(), [](const Line& a, const Line& b) { return a.stamp_ns < b.stamp_ns; });
  return out;
}

/// Scans whose stamp is not above the one before: the bag has them in the order of their stamps.
std::size_t lateScans(const core::CarmenLog& log) {
  std::size_t late = 0;
  for (std::size_t i = 1; i < log.scans.size(); ++i) late += log.scans[i].stamp_ns <= log.scans[i - 1].stamp_ns;
  return late;
}

std_msgs::Header headerAt(const ros::Time& stamp, const char* frame) {
  std_msgs::Header out;
  out.stamp = stamp, out.frame_id = frame;
  return out;
}

void writeLine(Recording& bag, const Line& line, const ros::Time& stamp, double max_range) {
  nav_msgs::Odometry odometry;
  odometry.header = headerAt(stamp, "odom"), odometry.child_frame_id = "base";
  odometry.pose.pose = tf2::toMsg(solid(line.odometry));
  bag.write("/odom", odometry);
  tf2_msgs::TFMessage tf;
  tf.transforms.push_back(transformMessage(stamp, "odom", "base", solid(line.odometry)));
  bag.write("/tf", stamp, tf, false);
  if (line.scan) bag.write("/scan", *scanMessage(headerAt(stamp, "laser"), core::scanOf(*line.scan, max_range)));
}

void convert(const Options& o) {
  const core::CarmenLog log = core::readCarmen(o.log, !o.logger_stamps);
  if (log.scans.empty()) throw std::runtime_error(o.log + ": no scan (FLASER, ROBOTLASER1 or RAWLASER1)");
  for (const core::CarmenScan& scan : log.scans)
    if (const auto fault = core::faultOf(core::scanOf(scan, o.max_range)); !fault.empty())
      throw std::runtime_error(o.log + ": " + fault);
  const core::Pose2 T_base_laser = laserPlace(o, log);
  const auto lines = linesOf(log);
  const auto start_ns = static_cast<std::int64_t>(std::llround(1e9 * o.start));
  if (lines.front().stamp_ns + start_ns <= 0)
    throw std::runtime_error(o.log + ": its first stamp is not above 0; add to all of them by --start SECONDS");
  const auto stampOf = [&](const Line& l) { return ros::Time().fromNSec(static_cast<std::uint64_t>(l.stamp_ns + start_ns)); };
  Recording bag(o.bag);
  bag.writeStatic({transformMessage(stampOf(lines.front()), "base", "laser", solid(T_base_laser))});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    writeLine(bag, lines[i], stampOf(lines[i]), o.max_range);
    showProgress(i + 1, lines.size(), "lines");
  }
  bag.finish();
  const auto [fewest, most] = std::minmax_element(
      log.scans.begin(), log.scans.end(), [](const auto& a, const auto& b) { return a.ranges.size() < b.ranges.size(); });
  std::cout << o.bag << ": " << log.scans.size() << " scans of " << fewest->ranges.size();
  if (most->ranges.size() > fewest->ranges.size()) std::cout << " to " << most->ranges.size();
  std::cout << " beams\n";
  if (const std::size_t late = lateScans(log); late > 0)
    std::cout << late << " scans are not stamped after the one before: they lie in the bag by their stamps\n";
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("Turns a CARMEN log into a bag: /scan, /odom, /tf (odom to base), /tf_static (base to laser).");
  app.add_option("log", o.log, "FLASER, ROBOTLASER1 or RAWLASER1 lines, and ODOM")->required();
  app.add_option("bag", o.bag, "file to write")->required();
  app.add_option("--laser", o.laser, "X Y YAW [m m deg] of the scanner on the robot (default: as the log says)")
      ->expected(3)->check(within(-1e6, 1e6));
  app.add_option("--max-range", o.max_range, "[m] of the scanner, where the log does not say")->capture_default_str()
      ->check(within(0.1, 1000.0));
  app.add_option("--start", o.start, "[s] added to every stamp")->check(within(-4e9, 4e9));
  app.add_flag("--logger-stamps", o.logger_stamps, "the stamps of the logger, not of who measured");
  CLI11_PARSE(app, argc, argv);
  try {
    std::error_code none;
    if (std::filesystem::equivalent(o.log, o.bag, none)) throw std::runtime_error(o.bag + " is the log itself");
    convert(o);
  } catch (const std::exception& e) {
    std::cerr << "carmen_to_bag: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
