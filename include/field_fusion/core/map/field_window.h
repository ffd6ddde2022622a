#pragma once
// The fields of a map around one place, side by side, for look-ups that cost one load.
#include <vector>

#include "field_fusion/core/map/tile_map.h"

namespace field_fusion::core {

/// Coordinates are cells from the window's corner, so that single precision has no more than 1e-4 cells to
/// lose. Fields are made when first looked at. Valid until the map changes.
class FieldWindow {
 public:
  /// Every cell within `radius` cells of (x, y) [cells of the map] is inside.
  void open(TileMap& map, double x, double y, double radius);

  double cornerX() const { return corner_.x * double{kTileSide}; }  ///< [cells of the map]
  double cornerY() const { return corner_.y * double{kTileSide}; }

  /// Of cell (x, y) of the window, with its coordinates from the corner of the tile that the cell is in; null: nothing
  /// is near, or outside.
  const Wall* nearest(int x, int y) {
    const auto tx = static_cast<unsigned>(x >> kTileBits), ty = static_cast<unsigned>(y >> kTileBits);
    if (tx >= side_ || ty >= side_) return nullptr;
    const NearestField*& field = fields_[ty * side_ + tx];
    if (!field) field = &map_->field({corner_.x + static_cast<int>(tx), corner_.y + static_cast<int>(ty)});
    return field->at(x, y);
  }
  /// [cells] of the tile's corner, from the window's.
  static float tileCorner(int x) { return static_cast<float>(x & ~(kTileSide - 1)); }

  /// Whether a beam has ever been in cell (x, y) of the window.
  bool seen(int x, int y) const {
    const Tile* tile = map_->tile({corner_.x + (x >> kTileBits), corner_.y + (y >> kTileBits)});
    return tile && tile->seen(x, y);
  }

 private:
  TileMap* map_ = nullptr;
  TilePlace corner_{0, 0};
  unsigned side_ = 0;  // [tiles]
  std::vector<const NearestField*> fields_;
};

}  // namespace field_fusion::core
