#include "field_fusion/core/io/carmen.h"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "field_fusion/core/io/lines.h"

namespace field_fusion::core {
namespace {

constexpr std::size_t kMaxBeams = 100000;

/// The words of one line, from left to right.
class Words {
 public:
  explicit Words(const std::string& line) : stream_(line) {}

  std::string word(const char* what) {
    std::string out;
    if (!(stream_ >> out)) throw std::runtime_error(std::string("the line ends before ") + what);
    return out;
  }
  double number(const char* what) {
    const std::string text = word(what);
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0') throw std::runtime_error(std::string(what) + " is '" + text + "'");
    return value;
  }
  std::size_t count(const char* what) {
    const double value = number(what);
    if (!(value >= 0.0 && value <= kMaxBeams && value == std::floor(value)))
      throw std::runtime_error(std::string(what) + " is no count: " + std::to_string(value));
    return static_cast<std::size_t>(value);
  }
  Pose2 pose(const char* what) {
    Pose2 out;
    for (double* v : {&out.x, &out.y, &out.yaw}) {
      *v = number(what);
      if (!std::isfinite(*v)) throw std::runtime_error(std::string(what) + " is not finite");
    }
    return out;
  }
  /// "stamp host stamp" at the end of every line.
  std::int64_t stamp(bool sensor_stamps) {
    const std::string sensor = word("the time stamp");
    word("the host");
    const std::string logger = word("the logger's time stamp");
    std::int64_t ns = 0;
    if (!parseStamp(sensor_stamps ? sensor : logger, ns))
      throw std::runtime_error("the time stamp is '" + (sensor_stamps ? sensor : logger) + "'");
    return ns;
  }

 private:
  std::istringstream stream_;
};

void readRanges(Words& words, CarmenScan& scan) {
  const std::size_t n = words.count("the number of beams");
  scan.ranges.reserve(n);
  for (std::size_t i = 0; i < n; ++i) scan.ranges.push_back(static_cast<float>(words.number("a range")));
}

/// Of the old lines, which do not tell it: a SICK with 180 or 181 beams has one a degree, and so on.
void guessAngles(CarmenScan& scan) {
  const std::size_t n = scan.ranges.size();
  const bool fine = n == 401;  // 100 degrees by quarters
  const double view = radians(fine ? 100.0 : 180.0);
  scan.angle_min = -view / 2.0;
  scan.angle_increment = n < 2 ? 0.0 : view / static_cast<double>(n % 2 == 1 ? n - 1 : n);
}

CarmenScan oldScan(Words& words) {
  CarmenScan scan;
  readRanges(words, scan);
  guessAngles(scan);
  scan.laser = words.pose("the laser's pose");
  scan.odometry = words.pose("the odometry's pose");
  return scan;
}

void readHead(Words& words, CarmenScan& scan) {
  words.number("the laser's type");
  scan.angle_min = words.number("the start angle");
  words.number("the field of view");
  scan.angle_increment = words.number("the angular resolution");
  scan.max_range = words.number("the maximum range");
  words.number("the accuracy"), words.number("the remission mode");
  readRanges(words, scan);
  const std::size_t remissions = words.count("the number of remissions");
  for (std::size_t i = 0; i < remissions; ++i) words.number("a remission");
}

CarmenScan robotScan(Words& words) {
  CarmenScan scan;
  readHead(words, scan);
  scan.laser = words.pose("the laser's pose");
  scan.odometry = words.pose("the robot's pose");
  for (const char* what : {"tv", "rv", "the forward safety distance", "the side safety distance", "the turn axis"})
    words.number(what);
  return scan;
}

void readLine(const std::string& line, bool sensor_stamps, CarmenLog& log) {
  Words words(line);
  const std::string kind = words.word("its kind");
  if (kind == "ODOM") {
    StampedPose2 odometry;
    odometry.pose = words.pose("the odometry's pose");
    for (const char* what : {"tv", "rv", "the acceleration"}) words.number(what);
    odometry.stamp_ns = words.stamp(sensor_stamps);
    log.odometry.push_back(odometry);
    return;
  }
  CarmenScan scan;
  if (kind == "FLASER") {
    scan = oldScan(words);
  } else if (kind == "ROBOTLASER1") {
    scan = robotScan(words);
  } else if (kind == "RAWLASER1") {
    readHead(words, scan);
    if (!log.odometry.empty()) scan.odometry = scan.laser = log.odometry.back().pose;
  } else {
    return;
  }
  scan.stamp_ns = words.stamp(sensor_stamps);
  log.scans.push_back(std::move(scan));
}

}  // namespace

bool parseStamp(const std::string& text, std::int64_t& stamp_ns) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !(std::abs(value) < 9e9)) return false;
  const std::size_t point = text.find('.');
  if (text.find_first_of("eEpPxX") != std::string::npos || point == std::string::npos) {
    stamp_ns = std::llround(value * 1e9);
    return true;
  }
  std::string digits = text.substr(point + 1, 9);
  digits.resize(9, '0');
  const std::string whole = text.substr(0, point);
  const std::int64_t seconds = std::strtoll(whole.c_str(), nullptr, 10), parts = std::strtoll(digits.c_str(), nullptr, 10);
  stamp_ns = seconds * 1'000'000'000 + (text[0] == '-' ? -parts : parts);
  return true;
}

Scan scanOf(const CarmenScan& scan, double unknown_max_range) {
  Scan out;
  out.angle_min = scan.angle_min, out.angle_increment = scan.angle_increment;
  out.range_max = scan.max_range > 0.0 ? scan.max_range : unknown_max_range;
  out.ranges = scan.ranges;
  return out;
}

CarmenLog readCarmen(const std::filesystem::path& file, bool sensor_stamps) {
  CarmenLog log;
  eachLine(file, [&](const std::string& line) { readLine(line, sensor_stamps, log); });
  return log;
}

}  // namespace field_fusion::core
