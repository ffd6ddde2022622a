#pragma once
// Text files that are read line by line.
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace field_fusion::core {

/// Calls read(line) for each line that is neither empty nor begins with #. Throws std::runtime_error for a file that
/// cannot be read, and with file, line and its words what `read` throws.
template <class Read>
void eachLine(const std::filesystem::path& file, const Read& read) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  if (std::filesystem::is_directory(file)) throw std::runtime_error(file.string() + " is a folder");
  if (in.peek() == 0x1f) throw std::runtime_error(file.string() + " is compressed: unpack it first (gunzip)");
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#' || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      read(line);
    } catch (const std::exception& e) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + e.what());
    }
  }
}

}  // namespace field_fusion::core
