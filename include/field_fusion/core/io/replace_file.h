#pragma once
// Files that are whole or as they were: a reader never finds half of one.
#include <filesystem>
#include <functional>
#include <ostream>

namespace field_fusion::core {

/// Calls write(stream) for a file of another name beside `file`, which then takes its place. Throws
/// std::runtime_error with the file's name, and leaves `file` as it was, where that fails.
void replaceFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace field_fusion::core
