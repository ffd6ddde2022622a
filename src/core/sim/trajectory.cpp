#include "field_fusion/core/sim/trajectory.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "way.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kStep = 0.5e-3;  // [s] half the span of a difference
// Speed for a shake: its mean over a span, so that the shake grows smoothly where the acceleration jumps.
constexpr double kPace = 0.4;   // [s]
constexpr double kLever = 0.3;  // [m] from the middle to the feet, by which a turn on the spot is walked

void require(bool holds, const std::string& reason) {
  if (!holds) throw std::invalid_argument(reason);
}

void check(const Trajectory::Limits& limits) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  require(positive(limits.speed), "speed must be above 0");
  require(positive(limits.acceleration), "acceleration must be above 0");
  require(positive(limits.turn_rate), "turn_rate must be above 0");
  require(limits.corner >= 0 && std::isfinite(limits.corner), "corner must not be below 0");
}

void check(const std::vector<Trajectory::WayPoint>& points, bool loop) {
  require(!points.empty(), "a way needs a way-point");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = "way-point " + std::to_string(i + 1);
    require(points[i].position.allFinite() && !std::isinf(points[i].yaw), name + " is not finite");
    require(points[i].pause >= 0 && std::isfinite(points[i].pause), name + ": pause must not be below 0");
    if (i == 0 && (!loop || points.size() == 1)) continue;
    const auto& before = points[i == 0 ? points.size() - 1 : i - 1];
    const bool turns = std::abs(angleDifference(points[i].yaw, before.yaw)) > 1e-9;  // NaN: does not
    require(before.position != points[i].position || turns,
            name + " is at the place of the one before it and does not differ in yaw");
  }
}

void check(const Shake& shake) {
  for (const Shake::Term& term : shake.terms)
    require(term.amplitude.allFinite() && term.phase.allFinite() && std::isfinite(term.frequency),
            "a term of the shake is not finite");
  require(shake.full_speed >= 0 && std::isfinite(shake.full_speed), "full_speed must not be below 0");
}

}  // namespace

struct Trajectory::Path {
  std::vector<Piece> pieces;
  bool loop = false;
  Shake shake;
  Carrier carrier;
  bool carrier_moves = false;

  double end() const { return pieces.back().begin + pieces.back().length; }

  /// T_world_way, neither carried nor shaken.
  Transform way(double time) const {
    double at = std::clamp(time, 0.0, end());
    if (loop && time > end() && end() > 0) at = std::fmod(time, end());
    auto piece = std::upper_bound(pieces.begin(), pieces.end(), at,
                                  [](double t, const Piece& next) { return t < next.begin; });
    --piece;  // the first one begins at 0
    const double t = std::min(at - piece->begin, piece->length);
    Transform T_world_way(Eigen::AngleAxisd(piece->yaw(t), Eigen::Vector3d::UnitZ()));
    T_world_way.translation() = piece->position(t);
    return T_world_way;
  }

  /// Of the shake. Its second derivative is bounded, or an inertial unit would feel knocks.
  double share(double time) const {
    if (shake.full_speed == 0) return 1.0;
    const Transform before = way(time - kPace / 2), after = way(time + kPace / 2);
    const Eigen::Matrix3d turn = before.linear().transpose() * after.linear();
    const double on_the_spot = kLever * std::atan2(turn(1, 0), turn(0, 0));
    const double speed =
        std::hypot((after.translation() - before.translation()).norm(), on_the_spot) / kPace;
    const double x = std::min(1.0, speed / shake.full_speed);
    return x * x * x * (10 + x * (-15 + 6 * x));
  }
};

Transform Shake::at(double time, double share) const {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Term& term : terms)
    sum.array() +=
        term.amplitude.array() * (term.phase.array() + 2 * radians(180.0) * term.frequency * time).sin();
  sum *= share;
  Transform T_way_body(Eigen::AngleAxisd(sum[2], Eigen::Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(sum[1], Eigen::Vector3d::UnitY()) *
                       Eigen::AngleAxisd(sum[0], Eigen::Vector3d::UnitX()));
  T_way_body.translation() = sum.tail<3>();
  return T_way_body;
}

Trajectory::Trajectory(const std::vector<WayPoint>& points, const Limits& limits, const Shake& shake) {
  check(limits);
  check(points, limits.loop);
  check(shake);
  auto path = std::make_shared<Path>();
  path->pieces = planWay(points, limits);
  path->loop = limits.loop;
  path->shake = shake;
  path_ = path;
}

Trajectory Trajectory::carriedBy(Carrier carrier, bool moves) const {
  auto path = std::make_shared<Path>(*path_);
  path->carrier = std::move(carrier);
  path->carrier_moves = moves;
  Trajectory carried(*this);
  carried.path_ = path;
  return carried;
}

Transform Trajectory::pose(double time) const {
  Transform pose = path_->way(time);
  if (path_->carrier) pose = path_->carrier(pose, time);
  return path_->shake.terms.empty() ? pose : pose * path_->shake.at(time, path_->share(time));
}

Eigen::Vector3d Trajectory::velocity(double time) const {
  const Eigen::Vector3d way = pose(time + kStep).translation() - pose(time - kStep).translation();
  return pose(time).linear().transpose() * way / (2 * kStep);
}

Eigen::Vector3d Trajectory::angularVelocity(double time) const {
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(pose(time - kStep).linear().transpose() * pose(time + kStep).linear()));
  return turn.axis() * turn.angle() / (2 * kStep);
}

double Trajectory::duration() const { return path_->end(); }

bool Trajectory::still() const {
  const bool shakes = !path_->shake.terms.empty() && path_->shake.full_speed == 0;
  return path_->end() == 0 && !shakes && !path_->carrier_moves;
}

}  // namespace field_fusion::core::sim
