#include "field_fusion/core/match/class_shape.h"

#include <algorithm>
#include <cmath>

namespace field_fusion::core {
namespace {

double valueOf(const Table& table, const std::string& label) {
  const auto found = table.find(label);
  return found == table.end() ? 0.0 : found->second;
}

bool sameClasses(const Table& a, const Table& b) {
  const auto same = [](const auto& one, const auto& other) { return one.first == other.first; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool fitInside(const Table& nets, const Table& diameters) {
  return std::all_of(nets.begin(), nets.end(),
                     [&](const auto& net) { return net.second < valueOf(diameters, net.first); });
}

}  // namespace

void ShapeParams::declare(Params& p) {
  p.number("class_diameters", class_diameters, {0.01, 100.0}, "m", When::kStart,
           "optimal: diameter of a body of each round class. Where the class is known by it or by length and "
           "width, the obstacle is the whole body, not only what is seen of it.");
  p.number("class_nets", class_nets, {0.01, 100.0}, "m", When::kStart,
           "optimal: of round classes that one can see into, the diameter of the sheer wall inside, such as "
           "the net of a cage.");
  p.number("class_lengths", class_lengths, {0.01, 100.0}, "m", When::kStart,
           "optimal: length of a body of each class that is a box.");
  p.number("class_widths", class_widths, {0.01, 100.0}, "m", When::kStart,
           "optimal: width of a body of each class that is a box.");
  p.number("size_spread", size_spread, {0.001, 1.0}, "", When::kLive,
           "optimal: by how much bodies of a class differ from its size, as a share of it.");
  p.rule([this] { return sameClasses(class_lengths, class_widths); },
         "class_lengths and class_widths must name the same classes");
  p.rule([this] { return fitInside(class_nets, class_diameters); },
         "class_nets must be smaller than class_diameters");
}

double ClassShape::extent() const { return isRound() ? diameter : std::hypot(length, width); }

ClassShape shapeOf(const std::string& label, const ShapeParams& params) {
  return {valueOf(params.class_diameters, label), valueOf(params.class_nets, label),
          valueOf(params.class_lengths, label), valueOf(params.class_widths, label)};
}

}  // namespace field_fusion::core
