#include "field_fusion/core/map/scan_insertion.h"

#include <cmath>
#include <cstdlib>

#include "field_fusion/core/map/ray.h"

namespace field_fusion::core {
namespace {

/// [units of Cell::x] A mean that moves less keeps the fields: 0.15 cells.
constexpr int kMoved = static_cast<int>(0.3f * Cell::kHalf);

}  // namespace

/// Keeps the tile that it is in: rays go from cell to cell.
class ScanInsertion::Writer {
 public:
  Writer(TileMap& map, std::uint64_t revision, std::vector<Changed>& changed)
      : map_(map), revision_(revision), changed_(changed) {}

  void visit(int x, int y) {
    Tile& tile = at(x, y);
    tile.visit(x, y);
    if (tile.isOccupied(x, y) && !map_.isOccupied(tile.at(x, y))) flip(tile, x, y);
  }

  void hit(int x, int y, float dx, float dy) {
    Tile& tile = at(x, y);
    const Cell old = tile.at(x, y);
    tile.hit(x, y, dx, dy);
    const Cell cell = tile.at(x, y);
    const bool occupied = tile.isOccupied(x, y), moved = std::abs(cell.x - old.x) > kMoved || std::abs(cell.y - old.y) > kMoved;
    if (map_.isOccupied(cell) != occupied)
      flip(tile, x, y);
    else if (occupied && moved)
      changed_.push_back({x, y});
  }

 private:
  Tile& at(int x, int y) {
    const int tile_x = x >> kTileBits, tile_y = y >> kTileBits;
    if (!tile_ || tile_x != place_.x || tile_y != place_.y) {
      place_ = {tile_x, tile_y};
      tile_ = &map_.writable(place_);
      tile_->revision = revision_;
    }
    return *tile_;
  }

  /// A wall that comes or goes.
  void flip(Tile& tile, int x, int y) {
    tile.setOccupied(x, y, !tile.isOccupied(x, y));
    changed_.push_back({x, y});
  }

  TileMap& map_;
  std::uint64_t revision_;
  std::vector<Changed>& changed_;
  Tile* tile_ = nullptr;
  TilePlace place_{0, 0};
};

void ScanInsertion::insert(const SlamScan& scan, const Pose2& T_map_base, double resolution,
                           std::uint64_t revision, TileMap& map) {
  changed_.clear();
  Writer writer(map, revision, changed_);
  const double scale = 1.0 / resolution;
  const auto cells = [&](const Eigen::Vector2f& p) -> Eigen::Vector2d {
    return scale * (T_map_base * Eigen::Vector2d(p.cast<double>()));
  };
  const Eigen::Vector2d from = cells(scan.origin);
  for (const ScanHit& hit : scan.hits) {
    const Eigen::Vector2d to = cells(hit.end);
    const int x1 = static_cast<int>(std::floor(to.x())), y1 = static_cast<int>(std::floor(to.y()));
    traverse(from.x(), from.y(), to.x(), to.y(), [&](int x, int y) {
      if (x != x1 || y != y1) writer.visit(x, y);
    });
    writer.hit(x1, y1, static_cast<float>(to.x() - x1 - 0.5), static_cast<float>(to.y() - y1 - 0.5));
  }
  for (const Eigen::Vector2f& end : scan.free) {
    const Eigen::Vector2d to = cells(end);
    traverse(from.x(), from.y(), to.x(), to.y(), [&](int x, int y) { writer.visit(x, y); });
  }
  for (const Changed& c : changed_) map.forget(c.x, c.y);
}

}  // namespace field_fusion::core
