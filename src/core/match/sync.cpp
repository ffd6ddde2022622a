#include "field_fusion/core/match/sync.h"

#include <algorithm>
#include <regex>
#include <set>

namespace field_fusion::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool isRelativeTopic(const std::string& name) {
  static const std::regex pattern("[A-Za-z][A-Za-z0-9_]*(/[A-Za-z0-9_]+)*");
  return std::regex_match(name, pattern);
}

}  // namespace

void SyncParams::declare(Params& p) {
  p.texts("cameras", cameras, When::kStart,
          "Names of the cameras; each sends its detections on NAME/detections. Empty: one, on detections.");
  p.number(
      "time_offset", time_offset, {-10.0, 10.0}, "s", When::kLive,
      "Added to the stamps of all detections, where the clock of the cameras is behind the LiDAR's. Of an "
      "offset longer than half their period the stamps show only what is over whole periods.");
  p.number("time_offsets", time_offsets, {-10.0, 10.0}, "s", When::kStart,
           "time_offset of single cameras, by name.");
  p.number("max_interval", max_interval, {0.0, 1.0}, "s", When::kLive,
           "Clusters and detections whose stamps differ by more are never put together.");
  p.number(
      "partner_timeout", partner_timeout, {0.0, 3600.0}, "s", When::kLive,
      "How long clusters wait for detections, and how long a sensor may be silent before nobody waits for "
      "it (wall time). Above the period and latency of the detector; a sensor with a longer period "
      "counts as silent after one and a half of its own.");
  p.rule([this] { return std::set<std::string>(cameras.begin(), cameras.end()).size() == cameras.size(); },
         "cameras has a name twice");
  p.rule([this] { return std::all_of(cameras.begin(), cameras.end(), isRelativeTopic); },
         "cameras has a name that is no relative topic: letters, digits, _ and /, a letter first");
  p.rule(
      [this] {
        return std::all_of(time_offsets.begin(), time_offsets.end(), [this](const auto& entry) {
          return std::find(cameras.begin(), cameras.end(), entry.first) != cameras.end();
        });
      },
      "time_offsets has a name that is not among cameras");
}

std::string SyncParams::topicOf(std::size_t camera) const {
  return cameras.empty() ? "detections" : cameras[camera] + "/detections";
}

double SyncParams::offsetOf(std::size_t camera) const {
  const auto own = cameras.empty() ? time_offsets.end() : time_offsets.find(cameras[camera]);
  return own == time_offsets.end() ? time_offset : own->second;
}

void Spacing::add(double gap) {
  gaps_[next_] = gap;
  next_ = (next_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
}

double Spacing::least() const {
  return count_ < kEnough ? 0.0 : *std::min_element(gaps_.begin(), gaps_.begin() + count_);
}

bool Sync::Frame::answered() const {
  return std::any_of(answers.begin(), answers.end(), [](const Answer& a) { return a.detections; });
}

void Sync::reset() {
  cameras_.assign(params_.cameraCount(), {});
  waiting_.clear();
  start_ = kNaN;
  lidar_heard_ = {};
  last_clusters_ = released_ = -kInfinity;
}

bool Sync::addClusters(double stamp, double now, const Message& clusters) {
  if (stamp <= last_clusters_) reset();
  hear(now);
  last_clusters_ = stamp;
  lidar_heard_.add(now);
  const bool camera =
      std::any_of(cameras_.begin(), cameras_.end(), [&](const Camera& c) { return !silent(c.heard, now); });
  if (!camera || stamp <= released_) {
    ++counts_.alone;
    for (Camera& c : cameras_) c.unanswered.push_back(stamp);
    forget(stamp);
    return false;
  }
  const auto later =
      std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& w) { return w.first.stamp > stamp; });
  waiting_.insert(later, {{stamp, now, clusters}, -1});
  return true;
}

bool Sync::addDetections(std::size_t camera, double stamp, double now, const Message& detections) {
  stamp += params_.offsetOf(camera);
  if (const auto& items = cameras_.at(camera).items; !items.empty() && stamp <= items.back().stamp) reset();
  hear(now);
  Camera& c = cameras_[camera];
  c.heard.add(now);
  if (!c.items.empty()) c.spacing.add(stamp - c.items.back().stamp);
  c.items.push_back({stamp, now, detections});
  while (!c.unanswered.empty() && c.unanswered.front() < stamp - params_.max_interval)
    c.unanswered.pop_front();
  if (c.items.size() > kQueue) {
    c.items.pop_front();
    ++counts_.dropped;
  }
  const auto met = std::remove_if(c.unanswered.begin(), c.unanswered.end(), [&](double clusters) {
    return std::abs(clusters - stamp) <= params_.max_interval;
  });
  if (met == c.unanswered.end()) return true;
  c.unanswered.erase(met, c.unanswered.end());
  ++counts_.late;
  return false;
}

void Sync::hear(double now) {
  if (std::isnan(start_)) start_ = now;
}

void Sync::Heard::add(double now) {
  if (!std::isnan(at)) arrivals.add(now - at);
  at = now;
}

/// A sensor that has not been heard yet counts from the first message of any.
bool Sync::silent(const Heard& heard, double now) const {
  const double patience = std::max(params_.partner_timeout, kPatience * heard.arrivals.least());
  return now - (std::isnan(heard.at) ? start_ : heard.at) >= patience;
}

bool Sync::settled(const Camera& camera, double stamp, double now) const {
  if (silent(camera.heard, now)) return true;
  if (camera.items.empty()) return false;
  const double last = camera.items.back().stamp;
  if (last >= stamp) return true;
  const double slack = kSlack * params_.max_interval;
  return last + camera.spacing.least() - stamp >= std::min(stamp - last - slack, params_.max_interval);
}

bool Sync::ready(const Waiting& waiting, double now) const {
  if (now - waiting.first.arrival >= params_.partner_timeout || waiting_.size() > kQueue) return true;
  return std::all_of(cameras_.begin(), cameras_.end(),
                     [&](const Camera& c) { return settled(c, waiting.first.stamp, now); });
}

std::optional<Sync::Frame> Sync::next(double now) {
  lead(now);
  if (waiting_.empty() || !ready(waiting_.front(), now)) return std::nullopt;
  if (waiting_.size() > kQueue) ++counts_.dropped;
  return release();
}

/// The LiDAR is silent: what a camera has seen since waits for the other cameras.
void Sync::lead(double now) {
  if (std::isnan(start_) || !silent(lidar_heard_, now)) return;
  double last = std::max(last_clusters_, released_);
  if (!waiting_.empty()) last = std::max(last, waiting_.back().first.stamp);
  const auto first = [this](const auto& holds) {
    return std::find_if(cameras_.begin(), cameras_.end(), holds);
  };
  auto leader = first([&](const Camera& c) { return !silent(c.heard, now); });
  if (leader == cameras_.end())
    leader = first([&](const Camera& c) { return !c.items.empty() && c.items.back().stamp > last; });
  if (leader == cameras_.end()) return;
  for (const Item& item : leader->items)
    if (item.stamp > last) waiting_.push_back({item, static_cast<int>(leader - cameras_.begin())});
}

Sync::Answer Sync::nearest(const Camera& camera, double stamp) const {
  Answer out;
  double least = kInfinity;
  for (const Item& item : camera.items) {
    const double distance = std::abs(item.stamp - stamp);
    if (distance >= least) continue;
    least = distance;
    out.offset = item.stamp - stamp;
    out.detections = distance <= params_.max_interval ? item.message : nullptr;
  }
  return out;
}

Sync::Frame Sync::release() {
  const Waiting front = std::move(waiting_.front());
  waiting_.pop_front();
  Frame frame{front.first.stamp, front.first.arrival, nullptr, front.leader, {}};
  for (Camera& camera : cameras_) {
    frame.answers.push_back(nearest(camera, frame.stamp));
    if (camera.items.empty() || camera.items.back().stamp < frame.stamp - params_.max_interval)
      frame.answers.back().offset = kNaN;  // the nearest is still to come
    if (!frame.answers.back().detections) camera.unanswered.push_back(frame.stamp);
  }
  if (frame.leader < 0)
    frame.clusters = front.first.message;
  else
    frame.answers[frame.leader] = {front.first.message, 0.0};
  ++(frame.leader >= 0 ? counts_.camera_only : frame.answered() ? counts_.pairs : counts_.alone);
  released_ = frame.stamp;
  forget(frame.stamp);
  return frame;
}

void Sync::forget(double stamp) {
  for (Camera& camera : cameras_) {
    while (camera.items.size() > 1 && camera.items.front().stamp < stamp - kMemory) camera.items.pop_front();
    while (camera.unanswered.size() > kQueue) camera.unanswered.pop_front();
  }
}

bool Sync::idle() const {
  if (!waiting_.empty()) return false;
  const double last = std::max(last_clusters_, released_);
  return std::all_of(cameras_.begin(), cameras_.end(),
                     [&](const Camera& c) { return c.items.empty() || c.items.back().stamp <= last; });
}

}  // namespace field_fusion::core
