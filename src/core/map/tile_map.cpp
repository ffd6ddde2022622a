#include "field_fusion/core/map/tile_map.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace field_fusion::core {

const TileMap::Slot* TileMap::slot(TilePlace place) const {
  const int x = (place.x >> kBlockBits) - x0_, y = (place.y >> kBlockBits) - y0_;
  if (x < 0 || x >= width_ || y < 0 || y >= height_) return nullptr;
  const auto& block = blocks_[static_cast<std::size_t>(y) * width_ + x];
  return block ? &block->slots[slotIndex(place)] : nullptr;
}

const Tile* TileMap::tile(TilePlace place) const {
  const Slot* found = slot(place);
  return found ? found->tile.get() : nullptr;
}

Cell TileMap::cell(int x, int y) const {
  const Tile* found = tile({x >> kTileBits, y >> kTileBits});
  return found ? found->at(x, y) : Cell();
}

Tile& TileMap::writable(TilePlace place) { return own(writableSlot(place).tile); }

TileMap::Slot& TileMap::writableSlot(TilePlace place) {
  const int x = place.x >> kBlockBits, y = place.y >> kBlockBits;
  if (x < x0_ || x >= x0_ + width_ || y < y0_ || y >= y0_ + height_) cover(x, y);
  return own(blocks_[static_cast<std::size_t>(y - y0_) * width_ + (x - x0_)]).slots[slotIndex(place)];
}

/// Only the list of blocks is moved: 8 bytes for 25 x 25 m.
void TileMap::cover(int block_x, int block_y) {
  constexpr int kMaxBlock = kMaxCell >> (kTileBits + kBlockBits);
  if (std::abs(block_x) > kMaxBlock || std::abs(block_y) > kMaxBlock)
    throw std::out_of_range("the map cannot hold a cell " + std::to_string(kMaxCell) + " cells from its origin");
  const bool empty = blocks_.empty();
  const int x0 = empty ? block_x : std::min(x0_, block_x), y0 = empty ? block_y : std::min(y0_, block_y);
  const int x1 = empty ? block_x + 1 : std::max(x0_ + width_, block_x + 1);
  const int y1 = empty ? block_y + 1 : std::max(y0_ + height_, block_y + 1);
  std::vector<boost::intrusive_ptr<Block>> blocks(static_cast<std::size_t>(x1 - x0) * (y1 - y0));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      blocks[static_cast<std::size_t>(y + y0_ - y0) * (x1 - x0) + (x + x0_ - x0)] =
          std::move(blocks_[static_cast<std::size_t>(y) * width_ + x]);
  blocks_ = std::move(blocks);
  x0_ = x0, y0_ = y0, width_ = x1 - x0, height_ = y1 - y0;
}

const NearestField& TileMap::field(TilePlace place) {
  static const NearestField kNothing;
  if (const Slot* found = slot(place); found && found->field) return *found->field;
  Neighbourhood around;
  bool any = false;
  for (int k = 0; k < 9; ++k) {
    around[k] = tile({place.x + k % 3 - 1, place.y + k / 3 - 1});
    any = any || around[k];
  }
  if (!any) return kNothing;
  auto made = nearestField(around);
  Slot& kept = writableSlot(place);
  kept.field = std::move(made);
  return *kept.field;
}

void TileMap::forget(int x, int y) {
  constexpr int kMargin = NearestField::kMargin;
  for (int ty = (y - kMargin) >> kTileBits; ty <= (y + kMargin) >> kTileBits; ++ty)
    for (int tx = (x - kMargin) >> kTileBits; tx <= (x + kMargin) >> kTileBits; ++tx)
      if (const Slot* found = slot({tx, ty}); found && found->field) writableSlot({tx, ty}).field.reset();
}

}  // namespace field_fusion::core
