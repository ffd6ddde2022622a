#include "field_fusion/ros/params_io.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <regex>

#include "field_fusion/core/base/params_text.h"

namespace field_fusion {
namespace {

using Rpc = XmlRpc::XmlRpcValue;
using core::Value;

/// Keys that image_transport, nodelet and diagnostic_updater keep in a node's namespace.
bool isForeign(const std::string& key) {
  static const std::regex known(
      "image_transport|num_worker_threads|use_multithread_callback|diagnostic_period|diagnostic_updater_.*|"
      "([^/]+/)?disable_pub_plugins|.*/(compressed|compressedDepth|theora)(/.*)?");
  return std::regex_match(key, known);
}

std::optional<double> number(Rpc value) {
  if (value.getType() == Rpc::TypeInt) return static_cast<int>(value);
  if (value.getType() == Rpc::TypeDouble) return static_cast<double>(value);
  return std::nullopt;
}

std::optional<Value> listOfNumbers(Rpc value) {
  std::vector<double> out;
  for (int i = 0; i < value.size(); ++i) {
    const auto n = number(value[i]);
    if (!n) return std::nullopt;
    out.push_back(*n);
  }
  return out;
}

std::optional<Value> listOfTexts(Rpc value) {
  std::vector<std::string> out;
  for (int i = 0; i < value.size(); ++i) {
    if (value[i].getType() != Rpc::TypeString) return std::nullopt;
    out.push_back(static_cast<std::string>(value[i]));
  }
  return out;
}

std::optional<Value> table(Rpc value) {
  core::Table out;
  for (auto& [key, entry] : value) {
    const auto n = number(entry);
    if (!n) return std::nullopt;
    out[key] = *n;
  }
  return out;
}

/// The received value in the declared type (given by `like`), or nothing when it is of another.
std::optional<Value> converted(const Rpc& value, const Value& like) {
  const auto type = value.getType();
  Rpc copy = value;  // XmlRpcValue converts only non-const
  if (std::holds_alternative<bool>(like) && type == Rpc::TypeBoolean) return Value(static_cast<bool>(copy));
  if (std::holds_alternative<int>(like) && type == Rpc::TypeInt) return Value(static_cast<int>(copy));
  if (std::holds_alternative<double>(like) && number(copy)) return Value(*number(copy));
  if (std::holds_alternative<std::string>(like) && type == Rpc::TypeString)
    return Value(static_cast<std::string>(copy));
  if (std::holds_alternative<std::vector<double>>(like) && type == Rpc::TypeArray) return listOfNumbers(copy);
  if (std::holds_alternative<std::vector<std::string>>(like) && type == Rpc::TypeArray)
    return listOfTexts(copy);
  if (std::holds_alternative<core::Table>(like) && type == Rpc::TypeStruct) return table(copy);
  return std::nullopt;
}

std::string typeName(const Rpc& value) {
  switch (value.getType()) {
    case Rpc::TypeBoolean:
      return "bool";
    case Rpc::TypeInt:
      return "int";
    case Rpc::TypeDouble:
      return "double";
    case Rpc::TypeString:
      return "string";
    case Rpc::TypeArray:
      return "list";
    case Rpc::TypeStruct:
      return "table";
    default:
      return "value of unknown type";
  }
}

/// Sets one parameter from what the server has as `key`, times `factor`; returns its fault, or empty.
std::string loadOne(const ros::NodeHandle& nh, const core::Param& param, const std::string& key, double factor = 1.0) {
  Rpc received;
  if (!nh.getParam(key, received)) return "";
  auto value = converted(received, param.get());
  if (!value) return key + " is a " + typeName(received) + " but must be a " + param.type();
  if (auto* number = std::get_if<double>(&*value)) *number *= factor;
  const auto fault = core::faultOf(param, *value);
  if (fault.empty()) param.set(*value);
  return fault.empty() || key == param.name ? fault : key + ": " + fault;
}

bool isOther(const std::string& key, const OtherNames& others) {
  return std::find(others.ignored.begin(), others.ignored.end(), key) != others.ignored.end() ||
         std::any_of(others.aliases.begin(), others.aliases.end(), [&](const auto& a) { return a.other == key; });
}

std::vector<std::string> unknownKeys(const ros::NodeHandle& nh, const core::Params& params, const OtherNames& others) {
  std::vector<std::string> keys, unknown;
  nh.getParamNames(keys);
  const auto prefix = nh.getNamespace() + "/";
  for (const auto& key : keys) {
    if (key.rfind(prefix, 0) != 0) continue;
    const auto local = key.substr(prefix.size());
    if (!params.find(local.substr(0, local.find('/'))) && !isForeign(local) && !isOther(local, others))
      unknown.push_back(local + " is not a parameter of this stage");
  }
  std::sort(unknown.begin(), unknown.end());
  return unknown;
}

std::vector<std::string> given(const ros::NodeHandle& nh, std::vector<std::string> names) {
  names.erase(std::remove_if(names.begin(), names.end(), [&](const auto& n) { return !nh.hasParam(n); }), names.end());
  return names;
}

Rpc toRpc(const Value& value) {
  if (const auto* b = std::get_if<bool>(&value)) return Rpc(*b);
  if (const auto* i = std::get_if<int>(&value)) return Rpc(*i);
  if (const auto* d = std::get_if<double>(&value)) return Rpc(*d);
  if (const auto* s = std::get_if<std::string>(&value)) return Rpc(*s);
  Rpc out;
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    out.setSize(static_cast<int>(numbers->size()));
    for (std::size_t i = 0; i < numbers->size(); ++i) out[static_cast<int>(i)] = (*numbers)[i];
  } else if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) {
    out.setSize(static_cast<int>(texts->size()));
    for (std::size_t i = 0; i < texts->size(); ++i) out[static_cast<int>(i)] = (*texts)[i];
  } else {
    for (const auto& [key, entry] : std::get<core::Table>(value)) out[key] = entry;
  }
  return out;
}

}  // namespace

std::vector<std::string> loadParams(const ros::NodeHandle& nh, const core::Params& params, const OtherNames& others) {
  std::vector<std::string> faults;
  const auto keep = [&](std::string fault) {
    if (!fault.empty()) faults.push_back(std::move(fault));
  };
  for (const auto& param : params.list()) keep(loadOne(nh, param, param.name));
  for (const auto& alias : others.aliases) keep(loadOne(nh, *params.find(alias.name), alias.other, alias.factor));
  if (faults.empty()) faults = params.faults();  // rules over several values mean little on half of them
  for (auto& fault : unknownKeys(nh, params, others)) faults.push_back(std::move(fault));
  if (faults.empty()) return given(nh, others.ignored);
  std::string text = nh.getNamespace() + ": ";
  for (std::size_t i = 0; i < faults.size(); ++i) text += (i ? "; " : "") + faults[i];
  throw std::invalid_argument(text);
}

void storeParams(const ros::NodeHandle& nh, const core::Params& params) {
  for (const auto& param : params.list()) nh.setParam(param.name, toRpc(param.get()));
}

}  // namespace field_fusion
