#pragma once
// The one vocabulary in which a parameter is declared. A stage's Params struct names each parameter
// once, in `declare`, with type, default, range, unit and meaning; loading, checking, the YAML
// defaults, docs/parameters.md and live reconfiguration are all derived from that declaration.
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace field_fusion::core {

/// Closed interval that a number, or each element of a list or table, must lie in.
struct Range {
  double lo, hi;
};

/// When a change takes effect: only at start-up, or at once. Lists and tables are read at start.
enum class When { kStart, kLive };

using Table = std::map<std::string, double>;
using Value =
    std::variant<bool, int, double, std::string, std::vector<double>, std::vector<std::string>, Table>;

/// One declared parameter, tied to the field that holds it.
struct Param {
  std::string name, unit, meaning;
  When when = When::kStart;
  Range range{0.0, 0.0};             ///< for int, double, and elements of lists and tables
  std::vector<std::string> choices;  ///< for enums, in the order of the enumerators
  std::function<Value()> get;        ///< an enum reads as its choice
  std::function<void(const Value&)> set;

  bool isEnum() const { return !choices.empty(); }
  /// "int", "double", "enum", "list of double" ...
  std::string type() const;
};

/// Collects what a Params struct declares. Parameters are named in snake_case; angles are degrees.
class Params {
 public:
  /// int, double, std::vector<double> or Table: `range` bounds the value or each element.
  template <class T>
  void number(const char* name, T& field, Range range, const char* unit, When when, const char* meaning) {
    bind(name, field, unit, when, meaning).range = range;
  }
  void flag(const char* name, bool& field, When when, const char* meaning) {
    bind(name, field, "", when, meaning);
  }
  void text(const char* name, std::string& field, When when, const char* meaning) {
    bind(name, field, "", when, meaning);
  }
  void texts(const char* name, std::vector<std::string>& field, When when, const char* meaning) {
    bind(name, field, "", when, meaning);
  }
  /// Enum whose enumerators 0, 1, ... are spelled as `choices`.
  template <class Enum>
  void choice(const char* name, Enum& field, std::vector<std::string> choices, When when,
              const char* meaning) {
    add({name,
         "",
         meaning,
         when,
         {0.0, 0.0},
         choices,
         [&field, choices] { return Value(choices.at(static_cast<std::size_t>(field))); },
         [&field, choices](const Value& v) {
           field = static_cast<Enum>(indexOf(choices, std::get<std::string>(v)));
         }});
  }

  /// Cross-field rule: `broken` with the reason, e.g. "min_range must be below max_range".
  void rule(std::function<bool()> holds, std::string reason) {
    rules_.push_back({std::move(holds), std::move(reason)});
  }

  const std::vector<Param>& list() const { return list_; }
  const Param* find(const std::string& name) const;

  /// One line for each value outside its range and each broken rule; empty means valid.
  std::vector<std::string> faults() const;

 private:
  struct Rule {
    std::function<bool()> holds;
    std::string reason;
  };
  template <class T>
  Param& bind(const char* name, T& field, const char* unit, When when, const char* meaning) {
    return add({name,
                unit,
                meaning,
                when,
                {0.0, 0.0},
                {},
                [&field] { return Value(field); },
                [&field](const Value& v) { field = std::get<T>(v); }});
  }
  Param& add(Param param);
  static std::size_t indexOf(const std::vector<std::string>& choices, const std::string& choice);

  std::vector<Param> list_;
  std::vector<Rule> rules_;
};

/// The declaration of `params`; the result refers to it and must not outlive it.
template <class P>
Params declarationOf(P& params) {
  Params declared;
  params.declare(declared);
  return declared;
}

/// Fault of one value against its parameter ("epsilon = -3.0 is outside [0.01, 5.0] m"), or empty.
std::string faultOf(const Param& param, const Value& value);

}  // namespace field_fusion::core
