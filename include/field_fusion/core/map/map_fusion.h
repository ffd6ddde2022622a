#pragma once
// Stage `map_fusion`: map A of the scanner and map B of the depth camera as one (paper 004, Algorithm 2, Eq.
// 5 and Table 2).
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/params.h"
#include "field_fusion/core/map/occupancy.h"

namespace field_fusion::core {

struct MapFusionParams {
  double occupied = 0.5;
  double clamp_min = 0.12;
  double clamp_max = 0.97;
  double max_side = 400.0;

  void declare(Params& p) {
    p.number("occupied", occupied, {0.01, 0.99}, "", When::kLive,
             "Probability from which a cell of either map is occupied, and with it the fused one (Table 2).");
    p.number("clamp_min", clamp_min, {0.001, 0.5}, "", When::kLive, "No cell's probability counts as less.");
    p.number("clamp_max", clamp_max, {0.5, 0.999}, "", When::kLive, "Nor as more.");
    p.number("max_side", max_side, {1.0, 10000.0}, "m", When::kLive,
             "A map with which the fused one would be longer is refused: a wrong transform puts a local map anywhere.");
    p.rule([this] { return clamp_min < occupied && occupied < clamp_max; },
           "occupied must lie between the clamps");
  }
};

/// Log-odds of a cell from those of its two maps; NaN: not known. Their sum is Eq. 5, the product of the
/// odds. A cell that either has as occupied is so (Table 2), and never by less than the higher of the two: a scan's
/// way over a low box says nothing of the box.
float fusedLogOdds(float a, float b, float occupied, float least, float most);

/// Keeps for each cell what each map said of it last, and replaces that: a map that comes again makes no cell
/// surer. Where a map is silent:
enum class Silence {
  kForgets,  ///< it is whole: what it no longer tells of is gone, also beyond its own bounds
  kKeeps     ///< it is a window that moves: what it told of before holds
};

class MapFusion {
 public:
  explicit MapFusion(const MapFusionParams& params = {}) { setParams(params); }
  /// Throws std::invalid_argument with every fault of the parameters. What was fused is fused anew.
  void setParams(const MapFusionParams& params);

  /// Cells in percent, -1 not known. Throws std::runtime_error ("map damaged: ...", "resolution differs:
  /// ...", "map too far: ..."), and changes nothing, where the cells are none of that, are not of the size of
  /// the first map's, or the fused map would become longer than max_side or of more than kMostCells. A map whose
  /// cells lie between those of the others is moved to the nearest by up to half a cell: shift().
  void addA(const Occupancy& map, Silence silence) { add(a_, map, silence); }
  void addB(const Occupancy& map, Silence silence) { add(b_, map, silence); }
  void clear();

  /// All that is known; grows and does not shrink.
  const Occupancy& map() const { return fused_; }
  /// A square of `side` [m] about a place.
  Occupancy about(double x, double y, double side) const;
  double shift() const { return shift_; }  ///< [cells] of the map that came last

  static constexpr int kMostCells = 1 << 28;

 private:
  using Layer = std::vector<std::int8_t>;  // by area_
  void add(Layer& layer, const Occupancy& map, Silence silence);
  CellArea areaOf(const Occupancy& map);
  void cover(const CellArea& wanted, double resolution);
  void fuse(const CellArea& part);

  MapFusionParams params_;
  CellArea area_;
  Layer a_, b_;
  Occupancy fused_;
  double shift_ = 0.0;
  std::vector<std::int8_t> table_;  // fused percent by 102 * (a + 1) + b + 1
};

}  // namespace field_fusion::core
