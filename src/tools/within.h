#pragma once
// For options that are numbers.
#include <CLI/CLI.hpp>

#include <cmath>

namespace field_fusion {

/// CLI::Range, which lets "nan" through.
inline CLI::Validator within(double lo, double hi) {
  const CLI::Range range(lo, hi);
  return CLI::Validator(
      [range](std::string& text) {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && !std::isfinite(value)) return "'" + text + "' is not finite";
        return range(text);
      },
      range.get_description());
}

}  // namespace field_fusion
