#pragma once
// What a refusal says.
#include <gtest/gtest.h>

#include <exception>
#include <string>

namespace field_fusion::test {

/// The text of what `action` throws; empty where it throws nothing.
template <class Action>
std::string faultOf(Action&& action) {
  try {
    action();
  } catch (const std::exception& fault) {
    return fault.what();
  }
  return {};
}

inline testing::AssertionResult says(const std::string& fault, const std::string& text) {
  if (fault.find(text) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" is not in \"" << fault << '"';
}

}  // namespace field_fusion::test
