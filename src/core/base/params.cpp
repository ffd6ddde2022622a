#include "field_fusion/core/base/params.h"

#include <algorithm>
#include <stdexcept>

#include "field_fusion/core/base/params_text.h"

namespace field_fusion::core {
namespace {

const char* const kTypeNames[] = {
    "bool", "int", "double", "string", "list of double", "list of string", "table of double"};

/// Every number inside `value`, with its place ("[2]", "[car]", or "" for a plain number).
std::vector<std::pair<std::string, double>> numbersIn(const Value& value) {
  std::vector<std::pair<std::string, double>> out;
  if (const auto* i = std::get_if<int>(&value)) out.emplace_back("", *i);
  if (const auto* d = std::get_if<double>(&value)) out.emplace_back("", *d);
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    for (std::size_t i = 0; i < list->size(); ++i)
      out.emplace_back("[" + std::to_string(i) + "]", (*list)[i]);
  if (const auto* table = std::get_if<Table>(&value))
    for (const auto& [key, number] : *table) out.emplace_back("[" + key + "]", number);
  return out;
}

}  // namespace

std::string Param::type() const { return isEnum() ? "enum" : kTypeNames[get().index()]; }

const Param* Params::find(const std::string& name) const {
  const auto it = std::find_if(list_.begin(), list_.end(), [&](const Param& p) { return p.name == name; });
  return it == list_.end() ? nullptr : &*it;
}

std::vector<std::string> Params::faults() const {
  std::vector<std::string> out;
  for (const auto& param : list_)
    if (auto fault = faultOf(param, param.get()); !fault.empty()) out.push_back(std::move(fault));
  for (const auto& rule : rules_)
    if (!rule.holds()) out.push_back(rule.reason);
  return out;
}

Param& Params::add(Param param) {
  if (find(param.name)) throw std::logic_error("parameter " + param.name + " is declared twice");
  constexpr std::size_t kScalars = 4;  // the protocol of live change has no type for lists and tables
  if (param.when == When::kLive && param.get().index() >= kScalars)
    throw std::logic_error("parameter " + param.name + " is a " + param.type() + " and cannot be live");
  return list_.emplace_back(std::move(param));
}

std::size_t Params::indexOf(const std::vector<std::string>& choices, const std::string& choice) {
  const auto it = std::find(choices.begin(), choices.end(), choice);
  if (it == choices.end()) throw std::invalid_argument(choice + " is none of the choices");
  return static_cast<std::size_t>(it - choices.begin());
}

std::string faultOf(const Param& param, const Value& value) {
  if (param.isEnum()) {
    const auto& chosen = std::get<std::string>(value);
    const bool known = std::find(param.choices.begin(), param.choices.end(), chosen) != param.choices.end();
    return known ? "" : param.name + " = '" + chosen + "' is none of " + rangeText(param);
  }
  for (const auto& [place, number] : numbersIn(value))
    if (!(number >= param.range.lo && number <= param.range.hi))  // so written, NaN is a fault
      return param.name + place + " = " + floatText(number) + " is outside " + rangeText(param);
  return "";
}

}  // namespace field_fusion::core
