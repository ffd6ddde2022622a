#pragma once
// A bar on the terminal; silent where the output goes to a file.
#include <unistd.h>

#include <cstdio>
#include <string>

namespace field_fusion {

inline void showProgress(std::size_t done, std::size_t all, const char* unit = "frames") {
  constexpr std::size_t kWidth = 40;
  if (isatty(STDERR_FILENO) == 0) return;
  const std::size_t filled = kWidth * done / all;
  std::fprintf(stderr, "\r[%s%s] %zu/%zu %s%s", std::string(filled, '#').c_str(),
               std::string(kWidth - filled, '.').c_str(), done, all, unit, done == all ? "\n" : "");
}

}  // namespace field_fusion
