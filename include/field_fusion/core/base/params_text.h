#pragma once
// A declaration as text: YAML defaults, the table of docs/parameters.md, and parts of messages.
#include <string>

#include "field_fusion/core/base/params.h"

namespace field_fusion::core {

/// A double so that YAML reads it as one: "1.0", "1.0e-05", ".inf".
std::string floatText(double value);

/// As YAML writes it: true, 3, 0.5, text, [1.0, 2.0], {car: 1.5}.
std::string valueText(const Value& value);

/// "[0.01, 5.0] m" or "dbscan | euclidean"; empty where there is nothing to say.
std::string rangeText(const Param& param);

/// "name: default  # meaning. [range] unit, live": a line for each parameter.
std::string toYaml(const Params& params);

/// A Markdown table, one row for each parameter.
std::string toMarkdown(const Params& params);

}  // namespace field_fusion::core
