#pragma once
// How large a body of a class is and what it looks like from above.
#include <string>

#include "field_fusion/core/base/params.h"

namespace field_fusion::core {

/// Nominal sizes. Cage: the surface vessel's (paper 001), its net inside its floats. The others: typical.
struct ShapeParams {
  Table class_diameters{{"cage", 2.0}, {"buoy", 0.8}, {"bollard", 0.35}, {"cone", 0.3}, {"stool", 0.35}};
  Table class_nets{{"cage", 1.36}};
  Table class_lengths{{"car", 4.4}, {"balloon_car", 0.8}};
  Table class_widths{{"car", 1.8}, {"balloon_car", 1.6}};
  double size_spread = 0.1;

  void declare(Params& p);
};

/// Seen from above: a circle, a rectangle, or nothing that is known.
struct ClassShape {
  double diameter = 0.0;             ///< [m] of a round body, 0: not round
  double net = 0.0;                  ///< [m] diameter of a sheer wall inside it, 0: none
  double length = 0.0, width = 0.0;  ///< [m] of a box, 0: none

  bool isRound() const { return diameter > 0.0; }
  bool isBox() const { return length > 0.0; }
  bool isKnown() const { return isRound() || isBox(); }
  /// [m] Largest extent.
  double extent() const;
};

ClassShape shapeOf(const std::string& label, const ShapeParams& params);

}  // namespace field_fusion::core
