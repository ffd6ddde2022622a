#include "way.h"

#include <algorithm>
#include <array>

namespace field_fusion::core::sim {
namespace {

using WayPoint = Trajectory::WayPoint;
using Limits = Trajectory::Limits;

constexpr double kSharpest = radians(120.0);  // turn of the way that is still rounded
constexpr double kTurnRise = 0.5;             // [s] from rest to the full turn rate on the spot
// The velocity goes from one leg's to the next one's as 3 u^2 - 2 u^3, u = 0..1 over the curve's duration:
constexpr double kPeak = 1.5;      // largest acceleration over the mean one
constexpr double kCut = 3.0 / 32;  // distance to the way-point over (change of velocity x duration)

struct Phase {
  double length, speed, acceleration;  // [s] and what holds at its begin
};

/// Over a distance: faster, steady, slower. Both speeds must be in reach of each other.
std::array<Phase, 3> trapezoid(double distance, double from, double to, double most, double acceleration) {
  const double reachable = std::sqrt((from * from + to * to) / 2 + acceleration * distance);
  const double peak = std::max({std::min(most, reachable), from, to});
  const double rise = (peak - from) / acceleration, fall = (peak - to) / acceleration;
  const double rest = distance - rise * (from + peak) / 2 - fall * (to + peak) / 2;
  const double steady = peak > 0 ? std::max(0.0, rest) / peak : 0.0;
  return {{{rise, from, acceleration}, {steady, peak, 0.0}, {fall, peak, -acceleration}}};
}

/// A leg from one way-point to the next.
struct Leg {
  Eigen::Vector3d direction;  // unit vector; zero for a turn on the spot
  double length;              // [m]
  double yaw;                 // [rad]; NaN where it goes straight up or nowhere
};

/// How a way-point is passed. Not rounded: the speed is 0.
struct Corner {
  double turn = 0.0;                   // [rad] between the legs
  double level = 1.0;                  // least level speed in the curve, a share of `speed`
  double speed = 0.0;                  // [m/s]
  double duration = 0.0, reach = 0.0;  // [s] of the curve, [m] of each leg that it takes
};

class Planner {
 public:
  Planner(const std::vector<WayPoint>& points, const Limits& limits) : points_(points), limits_(limits) {
    if (limits.loop && points.size() > 1) points_.push_back(points.front());
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) legs_.push_back(leg(points_[i], points_[i + 1]));
    corners_.resize(points_.size());
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) corners_[i] = corner(i);
    fitSpeeds();
  }

  std::vector<Piece> run() {
    position_ = points_.front().position;
    yaw_ = points_.front().yaw;
    for (auto it = legs_.begin(); std::isnan(yaw_) && it != legs_.end(); ++it) yaw_ = it->yaw;
    if (std::isnan(yaw_)) yaw_ = 0.0;
    const double first_yaw = yaw_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool last = i + 1 == points_.size();
      if (corners_[i].speed > 0)
        curve(i);
      else
        stop(points_[i], last && limits_.loop ? first_yaw : points_[i].yaw, last);
      if (!last) drive(i);
    }
    if (pieces_.empty()) wait(0.0);
    return pieces_;
  }

 private:
  static Leg leg(const WayPoint& from, const WayPoint& to) {
    const Eigen::Vector3d way = to.position - from.position;
    const double length = way.norm();
    if (length == 0) return {way, 0.0, kNaN};
    const bool level = way.head<2>().norm() > 1e-6 * length;
    return {way / length, length, level ? std::atan2(way.y(), way.x()) : kNaN};
  }

  Corner corner(std::size_t i) const {
    const Leg &in = legs_[i - 1], &out = legs_[i];
    Corner corner;
    corner.turn = std::acos(std::clamp(in.direction.dot(out.direction), -1.0, 1.0));
    const double heading = std::abs(angleDifference(out.yaw, in.yaw));
    const bool rounded = points_[i].pause == 0 && std::isnan(points_[i].yaw) && limits_.corner > 0 &&
                         !std::isnan(heading) && std::max(corner.turn, heading) <= kSharpest;
    if (!rounded) return corner;
    corner.level =
        std::cos(heading / 2) * std::min(in.direction.head<2>().norm(), out.direction.head<2>().norm());
    const double s = std::max(1e-9, std::sin(corner.turn / 2));
    const double a = limits_.acceleration, turning = limits_.turn_rate * corner.level;
    const double half = std::min(in.length, out.length) / 2;
    const double cut = limits_.corner / (4 * kPeak * kCut);  // speed^2 s^2 / acceleration stays below it
    const double room = half / kPeak;                        // speed^2 s / acceleration stays below it
    corner.speed = std::min({limits_.speed, std::sqrt(cut * a) / s, cut * turning / (s * s),
                             std::sqrt(room * a / s), room * turning / s});
    return shaped(corner);
  }

  Corner shaped(Corner corner) const {
    if (corner.speed == 0) return corner;
    const double change = 2 * corner.speed * std::sin(corner.turn / 2);
    const double acceleration =
        std::min(limits_.acceleration, limits_.turn_rate * corner.level * corner.speed);
    corner.duration = kPeak * change / acceleration;
    corner.reach = corner.speed * corner.duration / 2;
    return corner;
  }

  double straight(std::size_t leg) const {
    return std::max(0.0, legs_[leg].length - corners_[leg].reach - corners_[leg + 1].reach);
  }

  /// Lowers the speeds of corners that cannot be reached, or left in time, on the straight between.
  void fitSpeeds() {
    const auto slow = [this](Corner& corner, const Corner& before, std::size_t leg) {
      const double reachable =
          std::sqrt(before.speed * before.speed + 2 * limits_.acceleration * straight(leg));
      if (corner.speed > reachable) corner = shaped({corner.turn, corner.level, reachable, 0.0, 0.0});
    };
    for (std::size_t i = 0; i < legs_.size(); ++i) slow(corners_[i + 1], corners_[i], i);
    for (std::size_t i = legs_.size(); i-- > 0;) slow(corners_[i], corners_[i + 1], i);
  }

  Piece& add(double length) {
    Piece piece;
    piece.begin = pieces_.empty() ? 0.0 : pieces_.back().begin + pieces_.back().length;
    piece.length = length;
    piece.p0 = position_;
    piece.yaw0 = yaw_;
    return pieces_.emplace_back(piece);
  }
  void close() {
    position_ = pieces_.back().position(pieces_.back().length);
    yaw_ = pieces_.back().yaw(pieces_.back().length);
  }

  void wait(double seconds) { add(seconds); }

  void turn(double to) {
    const double angle = angleDifference(to, yaw_), sign = angle < 0 ? -1.0 : 1.0;
    if (std::abs(angle) < 1e-12) return;
    for (const Phase& phase :
         trapezoid(std::abs(angle), 0, 0, limits_.turn_rate, limits_.turn_rate / kTurnRise)) {
      Piece& piece = add(phase.length);
      piece.yaw1 = sign * phase.speed;
      piece.yaw2 = sign * phase.acceleration / 2;
      close();
    }
  }

  void stop(const WayPoint& point, double yaw, bool last) {
    position_ = point.position;  // no rounding errors over many laps
    if (!std::isnan(yaw)) turn(yaw);
    if (point.pause > 0 && !(last && limits_.loop)) wait(point.pause);
  }

  void drive(std::size_t i) {
    const Leg& leg = legs_[i];
    if (corners_[i].speed == 0 && !std::isnan(leg.yaw)) turn(leg.yaw);
    for (const Phase& phase : trapezoid(straight(i), corners_[i].speed, corners_[i + 1].speed, limits_.speed,
                                        limits_.acceleration)) {
      if (phase.length <= 0) continue;
      Piece& piece = add(phase.length);
      piece.p1 = phase.speed * leg.direction;
      piece.p2 = phase.acceleration / 2 * leg.direction;
      close();
    }
  }

  void curve(std::size_t i) {
    const double d = corners_[i].duration;
    if (d <= 0) return;
    const Eigen::Vector3d from = corners_[i].speed * legs_[i - 1].direction;
    const Eigen::Vector3d change = corners_[i].speed * legs_[i].direction - from;
    Piece& piece = add(d);
    piece.along = true;
    piece.p1 = from;
    piece.p3 = change / (d * d);
    piece.p4 = -change / (2 * d * d * d);
    close();
  }

  std::vector<WayPoint> points_;
  Limits limits_;
  std::vector<Leg> legs_;
  std::vector<Corner> corners_;
  std::vector<Piece> pieces_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  double yaw_ = 0.0;
};

}  // namespace

std::vector<Piece> planWay(const std::vector<WayPoint>& points, const Limits& limits) {
  return Planner(points, limits).run();
}

}  // namespace field_fusion::core::sim
