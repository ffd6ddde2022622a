#include "field_fusion/core/io/relations.h"

#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "field_fusion/core/io/carmen.h"
#include "field_fusion/core/io/lines.h"

namespace field_fusion::core {
namespace {

/// Calls read(words) for each line; it says whether they are what they should be.
template <class Read>
void eachRow(const std::filesystem::path& file, const Read& read) {
  eachLine(file, [&read](const std::string& line) {
    std::istringstream words(line);
    if (!read(words)) throw std::runtime_error("'" + line + "'");
    if (std::string more; words >> more) throw std::runtime_error("'" + line + "' goes on after what belongs there");
  });
}

bool readStamp(std::istream& in, std::int64_t& ns) {
  std::string text;
  return static_cast<bool>(in >> text) && parseStamp(text, ns);
}

MeanAndDeviation statistics(const std::vector<double>& values, int power) {
  if (values.empty()) return {};
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += std::pow(v, power), squares += std::pow(v, 2 * power);
  const double n = static_cast<double>(values.size()), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean))};
}

std::int64_t microseconds(std::int64_t ns) { return (ns + (ns < 0 ? -500 : 500)) / 1000; }

}  // namespace

std::vector<Relation> readRelations(const std::filesystem::path& file) {
  std::vector<Relation> out;
  eachRow(file, [&out](std::istream& in) {
    Relation r;
    double z, roll, pitch;
    const bool good = readStamp(in, r.from_ns) && readStamp(in, r.to_ns) &&
                      in >> r.step.x >> r.step.y >> z >> roll >> pitch >> r.step.yaw && r.step.finite();
    out.push_back(r);
    return good;
  });
  return out;
}

std::vector<StampedPose2> readPoses(const std::filesystem::path& file) {
  std::vector<StampedPose2> out;
  eachRow(file, [&out](std::istream& in) {
    StampedPose2 p;
    const bool good = readStamp(in, p.stamp_ns) && in >> p.pose.x >> p.pose.y >> p.pose.yaw && p.pose.finite();
    out.push_back(p);
    return good;
  });
  return out;
}

MeanAndDeviation RelationScore::absoluteTranslation() const { return statistics(translation, 1); }
MeanAndDeviation RelationScore::squaredTranslation() const { return statistics(translation, 2); }
MeanAndDeviation RelationScore::absoluteRotation() const { return statistics(rotation, 1); }
MeanAndDeviation RelationScore::squaredRotation() const { return statistics(rotation, 2); }

RelationScore scoreRelations(const std::vector<StampedPose2>& poses, const std::vector<Relation>& relations) {
  std::unordered_map<std::int64_t, Pose2> at;
  for (const StampedPose2& p : poses) at[microseconds(p.stamp_ns)] = p.pose;
  RelationScore out;
  for (const Relation& r : relations) {
    const auto from = at.find(microseconds(r.from_ns)), to = at.find(microseconds(r.to_ns));
    if (from == at.end() || to == at.end()) {
      ++out.missing;
      continue;
    }
    const Pose2 error = between(r.step, between(from->second, to->second));
    out.translation.push_back(error.position().norm());
    out.rotation.push_back(std::abs(error.yaw));
  }
  return out;
}

}  // namespace field_fusion::core
