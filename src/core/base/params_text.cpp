#include "field_fusion/core/base/params_text.h"

#include <cmath>
#include <sstream>

namespace field_fusion::core {
namespace {

template <class Items, class Write>
std::string joined(const Items& items, const char* separator, Write write) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : separator) + write(item);
  return out;
}

std::string quoted(const std::string& text) {
  const bool plain =
      !text.empty() &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos;
  return plain ? text : '"' + text + '"';
}

struct ToText {
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(int i) const { return std::to_string(i); }
  std::string operator()(double d) const { return floatText(d); }
  std::string operator()(const std::string& s) const { return quoted(s); }
  std::string operator()(const std::vector<double>& l) const {
    return "[" + joined(l, ", ", floatText) + "]";
  }
  std::string operator()(const std::vector<std::string>& l) const {
    return "[" + joined(l, ", ", quoted) + "]";
  }
  std::string operator()(const Table& t) const {
    return "{" + joined(t, ", ", [](const auto& e) { return quoted(e.first) + ": " + floatText(e.second); }) +
           "}";
  }
};

const char* whenText(When when) { return when == When::kLive ? "live" : "at start"; }

}  // namespace

std::string floatText(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  std::string text;
  for (int digits = 6; digits <= 17; ++digits) {  // the shortest that reads back as the same number
    std::ostringstream out;
    out.precision(digits);
    out << value;
    text = out.str();
    if (std::stod(text) == value) break;
  }
  // YAML takes "1" for an int and "1e-05" for a string
  if (text.find('.') == std::string::npos) {
    const auto exponent = text.find('e');
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  }
  return text;
}

std::string valueText(const Value& value) { return std::visit(ToText{}, value); }

std::string rangeText(const Param& param) {
  if (param.isEnum()) return joined(param.choices, " | ", [](const std::string& c) { return c; });
  const auto value = param.get();
  const auto unit = param.unit.empty() ? "" : " " + param.unit;
  if (std::holds_alternative<int>(value))
    return "[" + std::to_string(static_cast<long>(param.range.lo)) + ", " +
           std::to_string(static_cast<long>(param.range.hi)) + "]" + unit;
  const bool bounded = std::holds_alternative<double>(value) || std::holds_alternative<Table>(value) ||
                       std::holds_alternative<std::vector<double>>(value);
  return bounded ? "[" + floatText(param.range.lo) + ", " + floatText(param.range.hi) + "]" + unit : "";
}

std::string toYaml(const Params& params) {
  std::string out;
  for (const auto& p : params.list()) {
    const auto range = rangeText(p);
    out += p.name + ": " + valueText(p.get()) + "  # " + p.meaning + " " +
           (range.empty() ? "" : range + ", ") + whenText(p.when) + "\n";
  }
  return out;
}

std::string toMarkdown(const Params& params) {
  std::string out = "| parameter | type | default | range | change | meaning |\n|---|---|---|---|---|---|\n";
  for (const auto& p : params.list()) {
    auto range = rangeText(p);
    for (std::size_t at = 0; (at = range.find('|', at)) != std::string::npos; at += 2)
      range.replace(at, 1, "\\|");
    out += "| `" + p.name + "` | " + p.type() + " | `" + valueText(p.get()) + "` | " + range + " | " +
           whenText(p.when) + " | " + p.meaning + " |\n";
  }
  return out;
}

}  // namespace field_fusion::core
