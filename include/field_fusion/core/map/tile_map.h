#pragma once
// An occupancy grid in tiles. Copies share what neither changes; it grows without moving what is there.
#include <array>
#include <cstdint>
#include <vector>

#include "field_fusion/core/map/nearest_field.h"
#include "field_fusion/core/map/tile.h"

namespace field_fusion::core {

/// Place of a tile: cells [32 x, 32 x + 32) by [32 y, 32 y + 32). Cell (0, 0) begins at the origin.
struct TilePlace {
  int x, y;
};

/// Copies may be used by different threads at once.
class TileMap {
 public:
  static constexpr int kMaxCell = 1 << 24;  ///< [cells] from the origin: 839 km at 0.05 m

  /// Hits / visits from which a cell is occupied, for `field`.
  explicit TileMap(float occupied = 0.25f) : occupied_(occupied) {}

  /// Null where nothing is known.
  const Tile* tile(TilePlace place) const;
  /// Without visits where nothing is known.
  Cell cell(int x, int y) const;

  /// For writing: shared with no other map. Throws std::out_of_range beyond kMaxCell.
  Tile& writable(TilePlace place);

  /// Computed when first asked for and kept; stays valid until the next call of `forget` nearby.
  const NearestField& field(TilePlace place);
  /// A cell became occupied, or no longer is, or its hits' mean moved: fields that depend on it are dropped.
  void forget(int x, int y);

  bool isOccupied(const Cell& cell) const {
    return cell.hits > 0 && static_cast<float>(cell.hits) >= occupied_ * static_cast<float>(cell.visits);
  }

  /// Calls visit(place, tile, field or null) for every tile.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (!blocks_[b]) continue;
      const int x0 = (x0_ + static_cast<int>(b) % width_) * kBlockSide,
                y0 = (y0_ + static_cast<int>(b) / width_) * kBlockSide;
      for (int s = 0; s < kBlockSide * kBlockSide; ++s)
        if (const Slot& slot = blocks_[b]->slots[s]; slot.tile)
          visit(TilePlace{x0 + s % kBlockSide, y0 + s / kBlockSide}, *slot.tile, slot.field.get());
    }
  }

 private:
  static constexpr int kBlockBits = 4, kBlockSide = 1 << kBlockBits;
  struct Slot {
    boost::intrusive_ptr<Tile> tile;
    boost::intrusive_ptr<NearestField> field;
  };
  struct Block : boost::intrusive_ref_counter<Block> {
    std::array<Slot, kBlockSide * kBlockSide> slots;
  };

  static int slotIndex(TilePlace p) {
    return (p.y & (kBlockSide - 1)) * kBlockSide + (p.x & (kBlockSide - 1));
  }
  const Slot* slot(TilePlace place) const;
  Slot& writableSlot(TilePlace place);
  void cover(int block_x, int block_y);

  float occupied_;
  int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;  // [blocks]
  std::vector<boost::intrusive_ptr<Block>> blocks_;
};

}  // namespace field_fusion::core
