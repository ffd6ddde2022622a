#pragma once
// Names under which users of another package know a stage's parameters.
#include <string>
#include <vector>

namespace field_fusion {

/// An alias wins where both names are given: the one was typed, the other may come from a file of defaults.
struct OtherNames {
  struct Alias {
    std::string other, name;  ///< `name` is a number; it becomes `factor` times the other's value
    double factor = 1.0;
  };
  std::vector<Alias> aliases;
  std::vector<std::string> ignored;  ///< mean nothing here: accepted, and told to the user
};

/// Those that a Params struct has, if it has.
template <class P>
auto otherNamesOf(int) -> decltype(P::otherNames()) {
  return P::otherNames();
}
template <class P>
OtherNames otherNamesOf(long) {
  return {};
}

}  // namespace field_fusion
