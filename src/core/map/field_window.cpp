#include "field_fusion/core/map/field_window.h"

#include <cmath>

namespace field_fusion::core {

void FieldWindow::open(TileMap& map, double x, double y, double radius) {
  map_ = &map;
  corner_ = {static_cast<int>(std::floor((x - radius) / kTileSide)),
             static_cast<int>(std::floor((y - radius) / kTileSide))};
  side_ = static_cast<unsigned>(std::floor(2.0 * radius / kTileSide)) + 2;
  fields_.assign(std::size_t{side_} * side_, nullptr);
}

}  // namespace field_fusion::core
