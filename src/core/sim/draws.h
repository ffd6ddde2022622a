#pragma once
// What a user of the robot does not know: where exactly its sensors sit, how large a body truly is.
#include <optional>
#include <string>

#include "random.h"

namespace field_fusion::core::sim {

class Draws {
 public:
  /// Without a seed all is as the files say.
  explicit Draws(std::optional<std::uint64_t> seed) : seed_(seed) {}

  /// The `place`-th number that belongs to `what`, evenly spread between -limit and limit. It depends on
  /// nothing else, so that a body more in a world changes no other.
  double within(double limit, const std::string& what, std::uint64_t place = 0) const {
    return seed_ ? limit * (2.0 * unitHash(seedOf(*seed_, what), place) - 1.0) : 0.0;
  }

 private:
  std::optional<std::uint64_t> seed_;
};

}  // namespace field_fusion::core::sim
