#pragma once
// Voxel maps as the files of OctoMap: .ot with all log-odds, .bt with occupied and free alone.
#include <filesystem>
#include <string>

#include "field_fusion/core/map/voxel_map.h"

namespace field_fusion::core {

/// Which of the two by the name's ending. Written under another name, which then takes the place of the old
/// file. Throws std::runtime_error where that fails or the name ends in neither.
void writeOctree(const std::filesystem::path& file, const VoxelMap& map);

/// What octomap_msgs/Octomap has as `data`: the tree alone, without a file's head. `binary` as in a .bt file.
/// Empty of a map without voxels.
std::string octreeData(const VoxelMap& map, bool binary);

/// Adds the voxels of a file to a map. Of a .bt, what is occupied gets the highest log-odds of the map and
/// what is free the lowest. Throws std::runtime_error with file and fault, and changes nothing, where it is
/// damaged or of another resolution.
void readOctree(const std::filesystem::path& file, VoxelMap& map);

}  // namespace field_fusion::core
