#pragma once
// Maps as map_server keeps them: a picture (PGM) and what it means (YAML).
#include <filesystem>

#include "field_fusion/core/map/occupancy.h"

namespace field_fusion::core {

/// Writes `yaml` and, beside it, the picture of the same name with .pgm. Each is written under another name and
/// then takes the place of the old one, the picture first: a reader never finds half a file. Throws
/// std::runtime_error where that fails or the name does not end in .yaml.
void writeMap(const std::filesystem::path& yaml, const Occupancy& map);

/// Reads what this or map_saver wrote: occupied from occupied_thresh on, free below free_thresh, the rest unknown.
/// Throws std::runtime_error with file and fault. A map that is turned (yaw of its origin) is refused.
Occupancy readMap(const std::filesystem::path& yaml);

}  // namespace field_fusion::core
