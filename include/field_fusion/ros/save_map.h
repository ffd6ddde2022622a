#pragma once
// What services that write a map to a file have in common.
#include <stdexcept>

#include "field_fusion/SaveMap.h"

namespace field_fusion {

/// Calls write(file), and answers with what it throws. A node has no folder of its user's: relative names are refused.
template <class Write>
void saveMap(const SaveMap::Request& request, SaveMap::Response& answer, const Write& write) try {
  if (request.file.empty() || request.file[0] != '/')
    throw std::runtime_error("'" + request.file + "' does not begin at /: give the whole path");
  write(request.file);
  answer.success = true;
} catch (const std::runtime_error& e) {
  answer.message = e.what();
}

}  // namespace field_fusion
