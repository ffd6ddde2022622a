#include "yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>
#include <stdexcept>

#include "field_fusion/core/base/types.h"

namespace field_fusion::core::sim {
namespace {

/// Letters to change, add, take away or swap with the next one (Damerau and Levenshtein).
std::size_t difference(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string shortNumber(double value) {
  if (value != 0 && !(std::abs(value) >= 1e-6 && std::abs(value) < 1e9)) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.6g", value);
    return digits;
  }
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string nearestName(const std::string& name, const std::vector<std::string>& known) {
  std::string best;
  std::size_t least = 1 + name.size() / 2;
  for (const std::string& candidate : known)
    if (const std::size_t d = difference(name, candidate); d < least) least = d, best = candidate;
  return best.empty() ? "" : " (did you mean " + best + "?)";
}

Yaml Yaml::file(const std::string& path) {
  try {
    return {YAML::LoadFile(path), std::make_shared<const std::string>(path), ""};
  } catch (const YAML::BadFile&) {
    throw std::runtime_error(path + ": cannot be read");
  } catch (const YAML::Exception& fault) {
    throw std::runtime_error(path + ":" + std::to_string(fault.mark.line + 1) + ": " + fault.msg);
  }
}

void Yaml::fail(const std::string& reason) const {
  const int line = std::max(node_.Mark().line, 0) + 1;  // an empty file has none
  throw std::runtime_error(*file_ + ":" + std::to_string(line) + ": " +
                           (key_.empty() ? "" : key_ + ": ") + reason);
}

void Yaml::check(const std::function<void()>& action) const {
  try {
    action();
  } catch (const std::invalid_argument& fault) {
    fail(fault.what());
  }
}

std::vector<std::string> Yaml::keys() const {
  if (!node_.IsMap()) fail("must be a table");
  std::vector<std::string> out;
  for (const auto& entry : node_) {
    const Yaml key(entry.first, file_, key_);
    if (!key.isText()) key.fail("a key must be a name");
    if (std::find(out.begin(), out.end(), key.text()) != out.end()) key.fail(key.text() + " is there twice");
    out.push_back(key.text());
  }
  return out;
}

void Yaml::onlyKeys(const std::vector<std::string>& known) const {
  for (const std::string& key : keys())
    if (std::find(known.begin(), known.end(), key) == known.end())
      (*this)[key].fail("unknown key" + nearestName(key, known));
}

bool Yaml::has(const std::string& key) const { return node_.IsMap() && node_[key].IsDefined(); }

Yaml Yaml::operator[](const std::string& key) const {
  if (!has(key)) fail("needs " + key);
  return {node_[key], file_, key_.empty() ? key : key_ + "." + key};
}

std::vector<Yaml> Yaml::list() const {
  if (!node_.IsSequence()) fail("must be a list");
  std::vector<Yaml> out;
  for (std::size_t i = 0; i < node_.size(); ++i)
    out.push_back({node_[i], file_, key_ + "[" + std::to_string(i) + "]"});
  return out;
}

double Yaml::number() const {
  double value;
  if (!node_.IsScalar() || !YAML::convert<double>::decode(node_, value)) fail("must be a number");
  if (!std::isfinite(value)) fail("must be finite");
  return value;
}

double Yaml::number(double lo, double hi) const {
  const double value = number();
  if (value < lo || value > hi)
    fail(shortNumber(value) + " is outside [" + shortNumber(lo) + ", " + shortNumber(hi) + "]");
  return value;
}

double Yaml::positive(double lo, double hi) const {
  const double value = number();
  if (value <= 0) fail(shortNumber(value) + " must be above 0");
  return number(lo, hi);
}

double Yaml::place() const { return number(-1e4, 1e4); }

double Yaml::angle() const { return radians(number(-3600, 3600)); }

int Yaml::whole(int lo, int hi) const {
  const double value = number(lo, hi);
  if (value != std::floor(value)) fail("must be a whole number");
  return static_cast<int>(value);
}

bool Yaml::flag() const {
  bool value;
  if (!node_.IsScalar() || !YAML::convert<bool>::decode(node_, value)) fail("must be true or false");
  return value;
}

std::string Yaml::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("must be a text");
  return node_.Scalar();
}

std::vector<double> Yaml::numbers(std::size_t fewest, std::size_t most) const {
  std::vector<double> out;
  for (const Yaml& item : list(fewest, most)) out.push_back(item.number());
  return out;
}

std::vector<Yaml> Yaml::list(std::size_t fewest, std::size_t most) const {
  std::vector<Yaml> out = list();
  if (out.size() >= fewest && out.size() <= most) return out;
  fail("must be a list of " + std::to_string(fewest) + (fewest == most ? "" : " to " + std::to_string(most)) +
       " numbers");
}

std::string Yaml::dump() const { return YAML::Dump(node_); }

std::size_t Yaml::oneOf(const std::vector<std::string>& choices) const {
  const auto it = std::find(choices.begin(), choices.end(), text());
  if (it != choices.end()) return static_cast<std::size_t>(it - choices.begin());
  std::string all;
  for (const std::string& choice : choices) all += (all.empty() ? "" : ", ") + choice;
  fail("'" + text() + "' is none of " + all);
}

}  // namespace field_fusion::core::sim
