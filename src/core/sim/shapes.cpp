#include "field_fusion/core/sim/shapes.h"

#include <cmath>
#include <stdexcept>

#include "shapes/kinds.h"

namespace field_fusion::core::sim {
namespace {

constexpr double kMostSize = 1000.0;  // [m]

template <class Map>
std::string names(const Map& map) {
  std::string out;
  for (const auto& entry : map) out += (out.empty() ? "" : ", ") + entry.first;
  return out;
}

/// Whatever is 0 by default may be; so may the share of rays that pass.
bool mayBeZero(const std::string& name, double by_default) {
  return by_default == 0.0 || name == "transparency";
}

void check(const std::string& shape, const std::string& name, double value, double by_default) {
  const std::string what = shape + ": " + name;
  if (!std::isfinite(value)) throw std::invalid_argument(what + " must be a finite number");
  if (value < 0.0 || (value == 0.0 && !mayBeZero(name, by_default)))
    throw std::invalid_argument(what + " must be " + (mayBeZero(name, by_default) ? "0 or more" : "above 0") +
                                ", not " + std::to_string(value));
  if (value != 0.0 && !(value >= 1e-6 && value <= kMostSize))
    throw std::invalid_argument(what + " must be 0.000001 to 1000");
  if (name == "transparency" && value > 1.0) throw std::invalid_argument(what + " must be 0..1");
}

}  // namespace

const std::map<std::string, ShapeKind>& shapeKinds() {
  static const ShapeKinds kinds = [] {
    ShapeKinds all;
    for (auto* part : {plainShapes, obstacleShapes, furnitureShapes, chairShapes, stoolShapes, boxShapes,
                       streetShapes, vehicleShapes, inflatedShapes, marineShapes, cageShapes, boatShapes,
                       buoyShapes, bollardShapes, personShapes, boardShapes})
      all.merge(part());
    return all;
  }();
  return kinds;
}

Model makeShape(const std::string& name, const ShapeParams& params) {
  const auto found = shapeKinds().find(name);
  if (found == shapeKinds().end())
    throw std::invalid_argument("no shape is named '" + name + "'; there are: " + names(shapeKinds()));
  ShapeParams all = found->second.defaults;
  for (const auto& [key, value] : params) {
    const auto known = all.find(key);
    if (known == all.end())
      throw std::invalid_argument(name + " has no parameter '" + key +
                                  "'; it has: " + names(found->second.defaults));
    check(name, key, value, known->second);
    known->second = value;
  }
  return found->second.make(all);
}

}  // namespace field_fusion::core::sim
