#include <cmath>
#include <filesystem>

#include "field_fusion/core/sim/sensor_models.h"
#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWaves = 32;  // that Caster takes
constexpr double kBreaks = 0.0706;      // amplitude over length at which deep water breaks (Stokes, Michell)
constexpr double kMostGrains = 96.0;    // in half a rough ground: each then still has four cells of its mesh

Wave readWave(const Yaml& yaml) {
  yaml.onlyKeys({"amplitude", "length", "heading_deg", "phase_deg"});
  Wave wave;
  wave.amplitude = yaml["amplitude"].number(0, 100);
  wave.length = yaml["length"].positive(0.01, 1e4);
  if (wave.amplitude > kBreaks * wave.length)
    yaml["amplitude"].fail(shortNumber(wave.amplitude) + " breaks: at a length of " + shortNumber(wave.length) +
                           " it must not be above " + shortNumber(kBreaks * wave.length));
  if (yaml.has("heading_deg")) wave.heading = yaml["heading_deg"].angle();
  if (yaml.has("phase_deg")) wave.phase = yaml["phase_deg"].angle();
  return wave;
}

/// Where the crests of all meet.
void checkSteepness(const Yaml& yaml, const std::vector<Wave>& waves) {
  double sum = 0.0;
  for (const Wave& wave : waves) sum += wave.amplitude / wave.length;
  if (sum > kBreaks * (1.0 + 1e-9))
    yaml.fail("break: their amplitudes over their lengths add up to " + shortNumber(sum) +
              ", which must not be above " + shortNumber(kBreaks));
}

/// Keys that a kind of ground has beside kind and material.
std::vector<std::string> keysOf(Ground::Kind kind) {
  switch (kind) {
    case Ground::Kind::kPlane:
      return {"slope_deg"};
    case Ground::Kind::kRough:
      return {"slope_deg", "roughness", "grain", "half_extent", "seed"};
    case Ground::Kind::kWater:
      return {"waves"};
    default:
      return {};
  }
}

Ground readGround(const Yaml& yaml) {
  Ground ground;
  ground.kind = static_cast<Ground::Kind>(yaml["kind"].oneOf({"none", "plane", "rough", "water"}));
  auto keys = keysOf(ground.kind);
  keys.insert(keys.end(), {"kind", "material"});
  yaml.onlyKeys(keys);
  if (yaml.has("slope_deg")) {
    const auto slope = yaml["slope_deg"].list();
    if (slope.size() != 2) yaml["slope_deg"].fail("must be [along x, along y]");
    for (int i = 0; i < 2; ++i)
      ground.slope[i] = std::tan(radians(slope[static_cast<std::size_t>(i)].number(-60, 60)));
  }
  if (yaml.has("roughness")) ground.roughness = yaml["roughness"].number(0, 10);
  if (yaml.has("grain")) ground.grain = yaml["grain"].positive();
  if (yaml.has("half_extent")) ground.half_extent = yaml["half_extent"].positive(0.1, 1e4);
  if (ground.kind == Ground::Kind::kRough && ground.half_extent > kMostGrains * ground.grain)
    yaml[yaml.has("grain") ? "grain" : "half_extent"].fail(
        "a half_extent of " + shortNumber(ground.half_extent) + " is more than 96 grains of " +
        shortNumber(ground.grain));
  if (yaml.has("seed")) ground.seed = static_cast<unsigned>(yaml["seed"].whole(0, 1000000000));
  if (yaml.has("waves"))
    for (const Yaml& wave : yaml["waves"].list()) ground.waves.push_back(readWave(wave));
  if (ground.waves.size() > kMostWaves) yaml["waves"].fail("must not be more than 32");
  if (!ground.waves.empty()) checkSteepness(yaml["waves"], ground.waves);
  if (yaml.has("material")) readMaterial(yaml["material"], ground.material);
  return ground;
}

Light readLight(const Yaml& yaml) {
  yaml.onlyKeys({"sun_azimuth_deg", "sun_elevation_deg", "sun", "sky", "sun_colour", "zenith", "horizon",
                 "clouds", "cloud_size", "cloud_seed", "visibility"});
  Light light;
  Polar sun = polar(light.to_sun);
  if (yaml.has("sun_azimuth_deg")) sun.azimuth = yaml["sun_azimuth_deg"].angle();
  if (yaml.has("sun_elevation_deg")) sun.elevation = radians(yaml["sun_elevation_deg"].number(-90, 90));
  light.to_sun = cartesian({1.0, sun.azimuth, sun.elevation});
  if (yaml.has("sun")) light.sun = yaml["sun"].number(0, 1000);
  if (yaml.has("sky")) light.sky = yaml["sky"].number(0, 1000);
  const auto colour = [&yaml](const char* key, Eigen::Vector3f& out) {
    if (!yaml.has(key)) return;
    const auto n = yaml[key].numbers(3, 3);
    out = Eigen::Vector3d(n[0], n[1], n[2]).cast<float>();
    if (!(out.minCoeff() >= 0.f && out.maxCoeff() <= 1.f && out.sum() > 0.f))
      yaml[key].fail("must be [red, green, blue] of 0..1, not black");
  };
  colour("sun_colour", light.sun_colour), colour("zenith", light.zenith), colour("horizon", light.horizon);
  if (yaml.has("clouds")) light.clouds = yaml["clouds"].number(0, 1);
  if (yaml.has("cloud_size")) light.cloud_size = yaml["cloud_size"].positive();
  if (yaml.has("cloud_seed")) light.cloud_seed = static_cast<unsigned>(yaml["cloud_seed"].whole(0, 1000));
  if (yaml.has("visibility")) light.visibility = yaml["visibility"].positive();
  return light;
}

std::vector<Dimension> readDimensions(const Yaml& yaml) {
  std::vector<Dimension> out;
  for (const Yaml& item : yaml.list()) {
    item.onlyKeys({"name", "from", "to"});
    Dimension dimension{item["name"].text(), readFrame(item["from"]).translation(),
                        readFrame(item["to"]).translation()};
    if (dimension.length() == 0) item.fail("both ends are at one place");
    for (const Dimension& other : out)
      if (other.name == dimension.name) item.fail("two dimensions are named " + other.name);
    out.push_back(std::move(dimension));
  }
  return out;
}

/// What sees needs light: not below the ground, not in the robot's own body.
void checkSees(const World& world, const Mount& mount, const Yaml& yaml) {
  const Eigen::Vector3d p = (world.robot.way.pose(0) * mount.T_base_sensor).translation();
  if (p.z() < world.ground.height(p.x(), p.y(), 0))
    yaml.fail("the sensor " + mount.name + " is below the ground at the start");
  if (inside(world.robot.model, mount.T_base_sensor.translation(), 0))
    yaml.fail("the sensor " + mount.name + " is inside the robot's own body");
}

/// Sensors and the middle of the robot's own body, against every other body.
void checkRobotIsFree(const World& world, const std::string& sensors, const Yaml& yaml) {
  const auto& mounts = world.robot.mounts;
  const bool has_body = !world.robot.model.links.empty();
  std::vector<Eigen::Vector3d> places;
  for (const Mount& mount : mounts) places.push_back(mount.T_base_sensor.translation());
  places.push_back(has_body ? world.robot.model.box().center() : Eigen::Vector3d(0, 0, 0.05));
  if (const auto touch = firstTouch(world, places)) {
    const bool robot = touch->place == mounts.size();
    const std::string when = touch->time > 0 ? "after " + shortNumber(touch->time) + " s" : "at the start";
    (robot ? yaml : yaml["mounts"].list()[touch->place])
        .fail((robot ? "the robot" : "the sensor " + mounts[touch->place].name) + " is inside the body " +
              touch->body->name + " " + when);
  }
  for (std::size_t i = 0; i < mounts.size(); ++i)
    if (sensorKind(sensors, mounts[i].model).sees) checkSees(world, mounts[i], yaml["mounts"].list()[i]);
}

}  // namespace

World loadWorld(const std::string& file, const std::string& sensors, std::optional<std::uint64_t> seed) {
  const Yaml yaml = Yaml::file(file);
  yaml.onlyKeys({"name", "ground", "light", "size_spread", "bodies", "robot", "dimensions"});
  const Draws draws(seed);
  World world;
  world.name = yaml.has("name") ? yaml["name"].text() : fs::path(file).stem().string();
  if (yaml.has("ground")) world.ground = readGround(yaml["ground"]);
  if (yaml.has("light")) world.light = readLight(yaml["light"]);
  const double spread = yaml.has("size_spread") ? yaml["size_spread"].number(0, kMostSpread) : 0.0;
  if (yaml.has("bodies")) world.bodies = readBodies(yaml["bodies"], world.ground, spread, draws);
  if (yaml.has("dimensions")) world.dimensions = readDimensions(yaml["dimensions"]);
  const std::string beside = (fs::path(file).parent_path() / ".." / "sensors").lexically_normal().string();
  if (yaml.has("robot")) {
    const std::string& folder = sensors.empty() ? beside : sensors;
    world.robot = readRobot(yaml["robot"], world.ground, folder, draws);
    checkRobotIsFree(world, folder, yaml["robot"]);
  }
  return world;
}

}  // namespace field_fusion::core::sim
