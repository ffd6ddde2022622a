#include "field_fusion/core/calib/rest.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace field_fusion::core {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

double distance(const Corners& a, const Corners& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(a.size()));
}

/// `corners` in the order in which they lie nearer to `other`.
Corners alike(Corners corners, const Corners& other) {
  Corners turned(corners.rbegin(), corners.rend());
  return distance(turned, other) < distance(corners, other) ? turned : corners;
}

/// Sightings while nothing moves, judged against the first: a slow drift must not pass.
class Run {
 public:
  explicit Run(const Sighting& first, std::size_t index)
      : first_(first), sum_(first.corners), begin_(first.stamp), end_(first.stamp), last_(index) {}

  bool take(const Sighting& next, std::size_t index, const RestParams& params) {
    const Corners corners = alike(next.corners, first_.corners);
    if (next.stamp - end_ > params.gap || distance(corners, first_.corners) > params.motion) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) sum_[i] += corners[i];
    ++count_, end_ = next.stamp, last_ = index;
    return true;
  }

  Rest rest() const {
    Rest rest{begin_, end_, sum_, last_};
    for (Eigen::Vector2d& corner : rest.corners) corner /= count_;
    return rest;
  }

 private:
  const Sighting& first_;
  Corners sum_;
  double begin_, end_;
  std::size_t last_;
  int count_ = 1;
};

}  // namespace

std::vector<Rest> findRests(const std::vector<Sighting>& sightings, const RestParams& params) {
  std::vector<Rest> out;
  const auto keep = [&](const Rest& rest) {
    if (rest.end - rest.begin < params.duration) return;
    if (!out.empty() && distance(alike(rest.corners, out.back().corners), out.back().corners) < params.step) return;
    out.push_back(rest);
  };
  for (std::size_t i = 0; i < sightings.size();) {
    if (sightings[i].corners.empty() || sightings[i].corners.size() != sightings[0].corners.size())
      throw std::invalid_argument("a sighting has no corners, or another number of them");
    Run run(sightings[i], i);
    std::size_t next = i + 1;
    while (next < sightings.size() && sightings[next].corners.size() == sightings[i].corners.size() &&
           run.take(sightings[next], next, params))
      ++next;
    keep(run.rest());
    i = next;
  }
  return out;
}

}  // namespace field_fusion::core
