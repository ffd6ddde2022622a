#include <cmath>

#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

using WayPoint = Trajectory::WayPoint;

/// Usual shaking. [Hz], [deg] of roll, pitch, yaw and [m] of x, y, z, [deg] of phase.
struct PresetTerm {
  double frequency, roll, pitch, yaw, x, y, z, phase;
};

struct Preset {
  double full_speed;  // [m/s]
  std::vector<PresetTerm> terms;
};

Preset preset(const Yaml& yaml) {
  switch (yaml.oneOf({"gait", "waves", "road"})) {
    case 0:  // a trot of two strides a second: rolls and sways with the stride, bounces with each step
      return {0.2,
              {{2.0, 1.5, 0.0, 0.7, 0.0, 0.006, 0.0, 0.0}, {4.0, 0.0, 1.0, 0.0, 0.003, 0.0, 0.008, 40.0}}};
    case 1:  // a small vessel in a light swell; of several lengths, so that it does not repeat soon
      return {0.0,
              {{0.23, 3.0, 0.0, 0.0, 0.0, 0.0, 0.05, 0.0},
               {0.31, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 70.0},
               {0.41, 2.0, 0.0, 0.5, 0.0, 0.0, 0.03, 130.0},
               {0.53, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 200.0}}};
    default:  // springs, and the wheels' hop, in full at the pace of a field track
      return {3.0,
              {{1.4, 0.4, 0.0, 0.0, 0.0, 0.0, 0.01, 0.0},
               {1.7, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 60.0},
               {11.0, 0.05, 0.08, 0.0, 0.0, 0.0, 0.001, 120.0}}};
  }
}

Shake::Term termOf(const PresetTerm& t, double scale) {
  Shake::Term term;
  term.amplitude << radians(t.roll), radians(t.pitch), radians(t.yaw), t.x, t.y, t.z;
  term.amplitude *= scale;
  term.frequency = t.frequency;
  term.phase.setConstant(radians(t.phase));
  return term;
}

Shake readShake(const Yaml& yaml) {
  Shake shake;
  if (yaml.isText() || yaml.isMap()) {
    if (yaml.isMap()) yaml.onlyKeys({"preset", "scale", "full_speed"});
    const double scale = yaml.has("scale") ? yaml["scale"].number(0, 100) : 1.0;
    const Preset usual = preset(yaml.isMap() ? yaml["preset"] : yaml);
    shake.full_speed = yaml.has("full_speed") ? yaml["full_speed"].number(0, 100) : usual.full_speed;
    for (const PresetTerm& term : usual.terms) shake.terms.push_back(termOf(term, scale));
    return shake;
  }
  for (const Yaml& term : yaml.list()) {
    term.onlyKeys({"frequency", "roll_deg", "pitch_deg", "yaw_deg", "x", "y", "z", "phase_deg"});
    const auto get = [&term](const char* key, double most) {
      return term.has(key) ? term[key].number(-most, most) : 0.0;
    };
    shake.terms.push_back(termOf({term["frequency"].positive(), get("roll_deg", 180), get("pitch_deg", 180),
                                  get("yaw_deg", 180), get("x", 100), get("y", 100), get("z", 100),
                                  get("phase_deg", 3600)},
                                 1.0));
  }
  return shake;
}

/// [x, y], [x, y, yaw_deg] or [x, y, z, yaw_deg].
WayPoint readPlace(const Yaml& yaml) {
  const auto items = yaml.list(2, 4);
  WayPoint point{{items[0].place(), items[1].place(), items.size() == 4 ? items[2].place() : 0.0}, kNaN, 0.0};
  if (items.size() > 2) point.yaw = items.back().angle();
  return point;
}

WayPoint readWayPoint(const Yaml& yaml) {
  if (yaml.isList()) return readPlace(yaml);
  yaml.onlyKeys({"at", "yaw_deg", "pause"});
  const auto at = yaml["at"].list(2, 3);
  WayPoint point{{at[0].place(), at[1].place(), at.size() == 3 ? at[2].place() : 0.0}, kNaN, 0.0};
  if (yaml.has("yaw_deg")) point.yaw = yaml["yaw_deg"].angle();
  if (yaml.has("pause")) point.pause = yaml["pause"].number(0, 1e6);
  return point;
}

Trajectory::Limits readLimits(const Yaml& motion) {
  Trajectory::Limits limits;
  if (motion.has("speed")) limits.speed = motion["speed"].positive(0.001, 1000);
  if (motion.has("acceleration")) limits.acceleration = motion["acceleration"].positive();
  if (motion.has("turn_rate_deg")) limits.turn_rate = radians(motion["turn_rate_deg"].positive());
  if (motion.has("corner")) limits.corner = motion["corner"].number(0, 1e6);
  if (motion.has("loop")) limits.loop = motion["loop"].flag();
  return limits;
}

Ride readRide(const Yaml& yaml, const Ground& ground) {
  const bool floats = yaml.has("floats") && yaml["floats"].flag();
  const bool leans = yaml.has("leans") && yaml["leans"].flag();
  if (floats && leans) yaml["leans"].fail("what floats leans anyway");
  if (floats && ground.kind != Ground::Kind::kWater) yaml["floats"].fail("the ground is no water");
  return floats ? Ride::kFloating : leans ? Ride::kLeaning : Ride::kUpright;
}

/// Samples of the way, against the edge of a rough ground.
void checkStaysOn(const Ground& ground, const Trajectory& way, const Yaml& yaml) {
  if (ground.kind != Ground::Kind::kRough) return;
  const double step = std::max(0.1, way.duration() / 1e6);
  for (double t = 0; t <= way.duration(); t += step)
    if (const Eigen::Vector2d p = way.pose(t).translation().head<2>();
        p.cwiseAbs().maxCoeff() > ground.half_extent)
      yaml.fail("leaves the ground, which ends " + shortNumber(ground.half_extent) + " m from the origin");
}

}  // namespace

Transform frameOf(const Eigen::Vector3d& place, const Eigen::Vector3d& roll_pitch_yaw) {
  Transform T(Eigen::AngleAxisd(roll_pitch_yaw.z(), Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(roll_pitch_yaw.y(), Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll_pitch_yaw.x(), Eigen::Vector3d::UnitX()));
  T.translation() = place;
  return T;
}

Transform readFrame(const Yaml& yaml) {
  const auto n = yaml.list(3, 6);
  if (n.size() != 3 && n.size() != 6) yaml.fail("must be [x, y, z] or [x, y, z, roll, pitch, yaw]");
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  if (n.size() == 6) turn = {n[3].angle(), n[4].angle(), n[5].angle()};
  return frameOf({n[0].place(), n[1].place(), n[2].place()}, turn);
}

Trajectory readWay(const Yaml& yaml, const Ground& ground, const Model& model,
                   const Eigen::Vector2d& offset) {
  std::vector<WayPoint> points;
  Trajectory::Limits limits;
  Shake shake;
  if (yaml.has("pose")) points.push_back(readPlace(yaml["pose"]));
  if (yaml.has("motion")) {
    const Yaml motion = yaml["motion"];
    motion.onlyKeys({"points", "speed", "acceleration", "turn_rate_deg", "corner", "loop", "shake"});
    if (motion.has("points") && yaml.has("pose")) motion["points"].fail("has the place in pose too");
    if (motion.has("points"))
      for (const Yaml& point : motion["points"].list()) points.push_back(readWayPoint(point));
    limits = readLimits(motion);
    if (motion.has("shake")) shake = readShake(motion["shake"]);
  }
  if (points.empty()) yaml.fail("needs pose, or motion with points");
  for (WayPoint& point : points) point.position.head<2>() += offset;
  const Yaml place = yaml.has("pose") ? yaml["pose"] : yaml["motion"]["points"];
  Trajectory way;
  place.check([&] { way = Trajectory(points, limits, shake); });
  checkStaysOn(ground, way, place);
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  if (!model.links.empty()) size = model.box().sizes();
  return carriedByGround(way, ground, readRide(yaml, ground), size.x(), size.y());
}

}  // namespace field_fusion::core::sim
