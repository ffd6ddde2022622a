#pragma once
// Parameters that a stage is given directly, not through a loader that has checked them.
#include <stdexcept>
#include <string>

#include "field_fusion/core/base/params.h"

namespace field_fusion::core {

/// The same parameters, or std::invalid_argument that names every value outside its range and every
/// broken rule.
template <class P>
P checked(P params) {
  std::string text;
  for (const std::string& fault : declarationOf(params).faults()) text += (text.empty() ? "" : "; ") + fault;
  if (!text.empty()) throw std::invalid_argument(text);
  return params;
}

}  // namespace field_fusion::core
