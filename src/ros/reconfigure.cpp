#include "field_fusion/ros/reconfigure.h"

#include "field_fusion/core/base/params_text.h"
#include "field_fusion/ros/params_io.h"

namespace field_fusion {
namespace {

using core::Param;
using core::Value;
using dynamic_reconfigure::Config;

bool isLive(const Param& param) { return param.when == core::When::kLive; }

template <class Entries, class T>
void append(Entries& entries, const std::string& name, const T& value) {
  entries.emplace_back();
  entries.back().name = name;
  entries.back().value = value;
}

void put(Config& config, const std::string& name, const Value& value) {
  if (const auto* b = std::get_if<bool>(&value)) append(config.bools, name, *b);
  if (const auto* i = std::get_if<int>(&value)) append(config.ints, name, *i);
  if (const auto* d = std::get_if<double>(&value)) append(config.doubles, name, *d);
  if (const auto* s = std::get_if<std::string>(&value)) append(config.strs, name, *s);
}

template <class Pick>
Config configOf(const core::Params& params, Pick pick) {
  Config config;
  for (const auto& param : params.list())
    if (isLive(param)) put(config, param.name, pick(param));
  config.groups.emplace_back();
  config.groups.back().name = "Default";
  config.groups.back().state = true;
  return config;
}

Config current(const core::Params& params) {
  return configOf(params, [](const Param& p) { return p.get(); });
}

/// A bound of the range in the parameter's type; text and flags have none of their own.
Value bound(const Param& param, double edge, bool flag) {
  const auto value = param.get();
  if (std::holds_alternative<int>(value)) return static_cast<int>(edge);
  if (std::holds_alternative<double>(value)) return edge;
  if (std::holds_alternative<bool>(value)) return flag;
  return std::string();
}

/// The choices as rqt_reconfigure reads them: a Python literal.
std::string editMethod(const Param& param) {
  if (!param.isEnum()) return "";
  std::string entries;
  for (const auto& choice : param.choices)
    entries += std::string(entries.empty() ? "" : ", ") + "{'name': '" + choice +
               "', 'type': 'str', 'value': '" + choice +
               "', 'description': '', 'srcline': 0, 'srcfile': '', 'cconsttype': 'const char * const', "
               "'ctype': 'std::string'}";
  return "{'enum_description': '" + param.name + "', 'enum': [" + entries + "]}";
}

dynamic_reconfigure::ConfigDescription describe(const core::Params& params) {
  static const char* const kTypes[] = {"bool", "int", "double", "str"};
  dynamic_reconfigure::ConfigDescription out;
  out.groups.emplace_back();
  out.groups.back().name = "Default";
  for (const auto& param : params.list()) {
    if (!isLive(param)) continue;
    auto& entry = out.groups.back().parameters.emplace_back();
    entry.name = param.name;
    entry.type = kTypes[param.get().index()];
    entry.description = param.meaning + (param.unit.empty() ? "" : " [" + param.unit + "]");
    entry.edit_method = editMethod(param);
  }
  out.dflt = current(params);
  out.min = configOf(params, [](const Param& p) { return bound(p, p.range.lo, false); });
  out.max = configOf(params, [](const Param& p) { return bound(p, p.range.hi, true); });
  return out;
}

/// All values of a request in one list.
std::vector<std::pair<std::string, Value>> entriesOf(const Config& config) {
  std::vector<std::pair<std::string, Value>> out;
  for (const auto& e : config.bools) out.emplace_back(e.name, Value(static_cast<bool>(e.value)));
  for (const auto& e : config.ints) out.emplace_back(e.name, Value(static_cast<int>(e.value)));
  for (const auto& e : config.doubles) out.emplace_back(e.name, Value(e.value));
  for (const auto& e : config.strs) out.emplace_back(e.name, Value(e.value));
  return out;
}

std::string faultOfEntry(const core::Params& params, const std::string& name, const Value& value) {
  const auto* param = params.find(name);
  if (!param) return name + " is not a parameter of this stage";
  if (!isLive(*param)) return name + " cannot change while the stage runs";
  if (param->get().index() != value.index()) return name + " must be a " + param->type();
  return core::faultOf(*param, value);
}

}  // namespace

Reconfigure::Reconfigure(const ros::NodeHandle& nh, const core::Params& params, std::mutex& mutex,
                         std::function<void()> changed)
    : nh_(nh), params_(params), mutex_(mutex), changed_(std::move(changed)) {
  description_ = nh_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = nh_.advertise<Config>("parameter_updates", 1, true);
  description_.publish(describe(params_));
  updates_.publish(current(params_));
  service_ = nh_.advertiseService("set_parameters", &Reconfigure::onSet, this);
}

bool Reconfigure::onSet(dynamic_reconfigure::Reconfigure::Request& request,
                        dynamic_reconfigure::Reconfigure::Response& response) {
  std::vector<std::string> faults;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    faults = apply(request.config);
  }  // only this service changes values, and its calls come one by one: reading on is safe, and the stage
     // goes on
  for (const auto& fault : faults) ROS_ERROR_STREAM(nh_.getNamespace() << ": change refused: " << fault);
  if (faults.empty()) storeParams(nh_, params_);
  response.config = current(params_);
  updates_.publish(response.config);
  return true;  // the answer tells what is in force, as the protocol has it
}

std::vector<std::string> Reconfigure::apply(const Config& wanted) {
  const auto entries = entriesOf(wanted);
  std::vector<std::string> faults;
  for (const auto& [name, value] : entries)
    if (auto fault = faultOfEntry(params_, name, value); !fault.empty()) faults.push_back(std::move(fault));
  if (!faults.empty()) return faults;
  std::vector<Value> before;
  for (const auto& param : params_.list()) before.push_back(param.get());
  for (const auto& [name, value] : entries) params_.find(name)->set(value);
  faults = params_.faults();
  if (faults.empty()) try {
      changed_();
    } catch (const std::exception& e) {
      faults.push_back(e.what());
    }
  if (!faults.empty()) {
    for (std::size_t i = 0; i < before.size(); ++i) params_.list()[i].set(before[i]);
  }
  return faults;
}

}  // namespace field_fusion
