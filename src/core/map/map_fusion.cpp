#include "field_fusion/core/map/map_fusion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field_fusion/core/base/checked.h"
#include "field_fusion/core/base/params_text.h"
#include "field_fusion/core/base/types.h"
#include "field_fusion/core/map/log_odds.h"

namespace field_fusion::core {
namespace {

constexpr int kValues = 102;  // -1 ... 100
constexpr int kGrain = 64;    // [cells] by which the map grows

template <class Cells>
Cells moved(const Cells& from, int width, int height, int new_width, int new_height, int right, int up) {
  Cells out(static_cast<std::size_t>(new_width) * new_height, kUnknownCell);
  for (int y = 0; y < height; ++y)
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(y) * width, width,
                out.begin() + static_cast<std::ptrdiff_t>(y + up) * new_width + right);
  return out;
}

}  // namespace

float fusedLogOdds(float a, float b, float occupied, float least, float most) {
  if (std::isnan(a) && std::isnan(b)) return kNaN;
  if (std::isnan(a)) return std::clamp(b, least, most);
  if (std::isnan(b)) return std::clamp(a, least, most);
  const float higher = std::max(a, b), sum = a + b;
  return std::clamp(higher >= occupied ? std::max(sum, higher) : sum, least, most);
}

void MapFusion::setParams(const MapFusionParams& params) {
  params_ = checked(params);
  const float occupied = logOddsOf(params_.occupied), least = logOddsOf(params_.clamp_min),
              most = logOddsOf(params_.clamp_max);
  const auto evidence = [&](int percent) {
    return percent < 0 ? kNaN : logOddsOf(std::clamp(0.01 * percent, params_.clamp_min, params_.clamp_max));
  };
  table_.clear();
  for (int a = -1; a <= 100; ++a)
    for (int b = -1; b <= 100; ++b) {
      const float fused = fusedLogOdds(evidence(a), evidence(b), occupied, least, most);
      table_.push_back(std::isnan(fused) ? kUnknownCell : percentOf(fused));
    }
  fuse(area_);
}

void MapFusion::clear() {
  area_ = {}, fused_ = {}, shift_ = 0.0;
  a_.clear(), b_.clear();
}

CellArea MapFusion::areaOf(const Occupancy& map) {
  const auto fail = [](const std::string& kind, const std::string& what) {
    throw std::runtime_error(kind + ": " + what);
  };
  if (!(map.resolution > 0.0 && std::isfinite(map.resolution)))
    fail("map damaged", "cells of " + floatText(map.resolution) + " m");
  if (map.width < 0 || map.height < 0 || map.cells.size() != static_cast<std::size_t>(map.width) * map.height)
    fail("map damaged", std::to_string(map.cells.size()) + " cells, not " + std::to_string(map.width) +
                            " x " + std::to_string(map.height));
  const auto wrong =
      std::find_if(map.cells.begin(), map.cells.end(), [](std::int8_t c) { return c < -1 || c > 100; });
  if (wrong != map.cells.end())
    fail("map damaged", "a cell of " + std::to_string(*wrong) + ", neither -1 nor 0 to 100");
  if (!a_.empty() && std::abs(map.resolution / fused_.resolution - 1.0) > 1e-4)
    fail("resolution differs",
         floatText(map.resolution) + " m, the maps before had " + floatText(fused_.resolution) + " m");
  const double x = map.x / map.resolution, y = map.y / map.resolution;
  if (!(std::abs(x) < kMostCells && std::abs(y) < kMostCells)) fail("map too far", "it is beyond all bounds");
  shift_ = std::max(std::abs(x - std::round(x)), std::abs(y - std::round(y)));
  return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), map.width, map.height};
}

void MapFusion::cover(const CellArea& wanted, double resolution) {
  const bool first = area_.width == 0 || area_.height == 0;
  const auto down = [](int cell) { return cell & ~(kGrain - 1); };
  const auto up = [](int cell) { return (cell + kGrain - 1) & ~(kGrain - 1); };
  int x0 = down(wanted.x0), y0 = down(wanted.y0), x1 = up(wanted.x0 + wanted.width),
      y1 = up(wanted.y0 + wanted.height);
  if (!first) {
    x0 = std::min(x0, area_.x0), x1 = std::max(x1, area_.x0 + area_.width);
    y0 = std::min(y0, area_.y0), y1 = std::max(y1, area_.y0 + area_.height);
  }
  const CellArea next = {x0, y0, x1 - x0, y1 - y0};
  if (!first && next.width == area_.width && next.height == area_.height) return;
  const double longest = resolution * std::max(next.width, next.height);
  if (longest > params_.max_side || static_cast<double>(next.width) * next.height > kMostCells)
    throw std::runtime_error("map too far: with it the fused map would be " + std::to_string(std::lround(longest)) +
                             " m long, of " + std::to_string(next.width) + " x " + std::to_string(next.height) + " cells");
  for (auto* cells : {&a_, &b_, &fused_.cells})
    *cells = moved(*cells, area_.width, area_.height, next.width, next.height, area_.x0 - x0, area_.y0 - y0);
  area_ = next;
}

void MapFusion::add(Layer& layer, const Occupancy& map, Silence silence) {
  const CellArea part = areaOf(map);
  if (map.cells.empty()) return;
  cover(part, map.resolution);
  if (fused_.width == 0) fused_.resolution = map.resolution;
  fused_.x = area_.x0 * fused_.resolution, fused_.y = area_.y0 * fused_.resolution;
  fused_.width = area_.width, fused_.height = area_.height;
  const bool forgets = silence == Silence::kForgets;
  if (forgets) std::fill(layer.begin(), layer.end(), kUnknownCell);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::int8_t cell = map.cells[static_cast<std::size_t>(y) * map.width + x];
      if (cell != kUnknownCell) layer[area_.index(part.x0 + x, part.y0 + y)] = cell;
    }
  fuse(forgets ? area_ : part);
}

void MapFusion::fuse(const CellArea& part) {
  for (int y = part.y0; y < part.y0 + part.height; ++y)
    for (int x = part.x0; x < part.x0 + part.width; ++x) {
      const std::size_t i = area_.index(x, y);
      fused_.cells[i] = table_[static_cast<std::size_t>(kValues * (a_[i] + 1) + b_[i] + 1)];
    }
}

Occupancy MapFusion::about(double x, double y, double side) const {
  return pictureOf(CellArea::about(x, y, side, fused_.resolution), fused_.resolution, [this](int u, int v) {
    return area_.contains(u, v) ? fused_.cells[area_.index(u, v)] : kUnknownCell;
  });
}

}  // namespace field_fusion::core
