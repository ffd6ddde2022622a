#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "field_fusion/core/sim/shapes.h"
#include "world_parts.h"

namespace field_fusion::core::sim {
namespace {

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Model shapeOf(const Yaml& yaml) {
  const std::string name = yaml["shape"].text();
  const auto& kinds = shapeKinds();
  std::vector<std::string> known;
  for (const auto& kind : kinds) known.push_back(kind.first);
  if (!kinds.count(name)) yaml["shape"].fail("no shape is named " + name + nearestName(name, known));

  ShapeParams params;
  if (yaml.has("params")) {
    known.clear();
    for (const auto& param : kinds.at(name).defaults) known.push_back(param.first);
    yaml["params"].onlyKeys(known);
    for (const std::string& key : yaml["params"].keys()) params[key] = yaml["params"][key].number();
  }
  Model model;
  (yaml.has("params") ? yaml["params"] : yaml["shape"]).check([&] { model = makeShape(name, params); });
  return model;
}

Model meshOf(const Yaml& yaml) {
  namespace fs = std::filesystem;
  if (yaml.has("params")) yaml["params"].fail("are for a shape, not for a mesh");
  const fs::path path = fs::path(yaml.fileName()).parent_path() / yaml["mesh"].text();
  const double scale = yaml.has("scale") ? yaml["scale"].positive() : 1.0;
  try {
    return {{{{{loadMesh(path.string(), scale), {}}}, {}}}};
  } catch (const std::runtime_error& fault) {
    yaml["mesh"].fail(fault.what());
  }
}

Model partsOf(const Yaml& parts) {
  Model model;
  for (const Yaml& part : parts.list()) {
    part.onlyKeys(joined(kModelKeys, {"at"}));
    const int first = static_cast<int>(model.links.size());
    for (Link& link :
         moved(readModel(part), part.has("at") ? readFrame(part["at"]) : Transform::Identity()).links) {
      if (link.parent >= 0) link.parent += first;
      model.links.push_back(std::move(link));
    }
  }
  if (model.links.empty()) parts.fail("must not be empty");
  return model;
}

/// Places of a grid: `count` along x and y, `step` m apart.
std::vector<Eigen::Vector2d> readRepeat(const Yaml& repeat) {
  repeat.onlyKeys({"count", "step"});
  const auto counts = repeat["count"].list(), steps = repeat["step"].list();
  if (counts.size() != 2 || steps.size() != 2) repeat.fail("count and step must be [along x, along y]");
  std::vector<Eigen::Vector2d> out;
  int count[2];
  double step[2];
  for (std::size_t i = 0; i < 2; ++i) {
    count[i] = counts[i].whole(1, 1000), step[i] = steps[i].place();
    if (count[i] > 1 && step[i] == 0) steps[i].fail("must not be 0: the bodies would stand in each other");
  }
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j) out.emplace_back(i * step[0], j * step[1]);
  return out;
}

/// [m] where a larger body stays as it is: its waterline if it floats, else what it stands on.
double footOf(const Yaml& yaml, const Model& model) {
  const bool floats = yaml.has("floats") && yaml["floats"].flag();
  return floats ? 0.0 : model.box().min().z();
}

/// What all bodies together must keep to.
class Crowd {
 public:
  void add(const Body& body, const Yaml& yaml) {
    if (!names_.insert(body.name).second) yaml.fail("two bodies are named " + body.name);
    if (names_.size() > kMostBodies) yaml.fail("there are more than 65534 bodies");
    const Eigen::Vector2d middle = body.way.pose(0).translation().head<2>();
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(body.size.head<2>().norm());
    area_.extend(middle - reach).extend(middle + reach);
    if (area_.volume() > kMostArea) yaml.fail("the bodies spread over more than 0.2 km^2, too much for a map");
  }

 private:
  static constexpr std::size_t kMostBodies = 65534;  // that a label of 16 bits can tell
  static constexpr double kMostArea = 0.2e6;         // [m^2]
  std::set<std::string> names_;
  Eigen::AlignedBox2d area_;
};

}  // namespace

Model readModel(const Yaml& yaml) {
  const int kinds = yaml.has("shape") + yaml.has("mesh") + yaml.has("parts");
  if (kinds != 1) yaml.fail("needs one of shape, mesh and parts");
  Model model = yaml.has("shape") ? shapeOf(yaml) : yaml.has("mesh") ? meshOf(yaml) : partsOf(yaml["parts"]);
  paint(yaml, model);
  return model;
}

std::vector<Body> readBodies(const Yaml& yaml, const Ground& ground, double size_spread, const Draws& draws) {
  std::vector<Body> bodies;
  Crowd crowd;
  for (const Yaml& item : yaml.list()) {
    item.onlyKeys(joined(joined(kModelKeys, kWayKeys), {"name", "label", "repeat", "size_spread"}));
    Body body;
    if (item.has("label")) body.label = item["label"].text();
    const double spread = item.has("size_spread") ? item["size_spread"].number(0, kMostSpread)
                          : body.label.empty()    ? 0.0
                                                  : size_spread;
    const Model nominal = readModel(item);
    const double foot = footOf(item, nominal);
    const bool several = item.has("repeat");
    const auto places = several ? readRepeat(item["repeat"]) : std::vector{Eigen::Vector2d(0, 0)};
    const std::string name = item["name"].text();
    for (std::size_t i = 0; i < places.size(); ++i) {
      body.name = several ? name + "_" + std::to_string(i + 1) : name;
      body.model = scaled(nominal, 1.0 + draws.within(spread, "size of " + body.name), foot);
      body.size = body.model.box().sizes();
      body.way = readWay(item, ground, body.model, places[i]);
      crowd.add(body, item);
      bodies.push_back(body);
    }
  }
  return bodies;
}

}  // namespace field_fusion::core::sim
