#include "field_fusion/core/match/assignment.h"

#include <algorithm>
#include <limits>

namespace field_fusion::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

const std::vector<int>& Assignment::run(int rows, int columns, const std::vector<Candidate>& candidates,
                                        double alone) {
  prepare(rows, columns, candidates, alone);
  for (int row = 0; row < rows; ++row) place(row, candidates, alone);
  return column_;
}

/// Prices are such that no candidate costs less than its row's and its column's together, nor a row left
/// alone less than its own; pairs cost exactly theirs.
void Assignment::prepare(int rows, int columns, const std::vector<Candidate>& candidates, double alone) {
  first_.assign(rows + 1, 0);
  row_price_.assign(rows, alone);
  for (const Candidate& c : candidates) {
    ++first_[c.row + 1];
    row_price_[c.row] = std::min(row_price_[c.row], c.cost);
  }
  for (int row = 0; row < rows; ++row) first_[row + 1] += first_[row];
  column_.assign(rows, -1);
  row_.assign(columns, -1);
  column_price_.assign(columns, 0.0);
  distance_.assign(columns, kInfinity);
  from_.assign(columns, -1);
  settled_.assign(columns, 0);
}

/// Dijkstra from the row over prices, to the nearest free column or the row that is best left alone.
void Assignment::place(int start, const std::vector<Candidate>& candidates, double alone) {
  int row = start, loner = start, column = -1;
  double length = 0.0, loner_length = alone - row_price_[start];
  for (;;) {
    for (int i = first_[row]; i < first_[row + 1]; ++i) {
      const Candidate& c = candidates[i];
      if (settled_[c.column]) continue;
      const double through = length + c.cost - row_price_[row] - column_price_[c.column];
      if (from_[c.column] < 0) reached_.push_back(c.column);
      if (from_[c.column] >= 0 && through >= distance_[c.column]) continue;
      distance_[c.column] = through;
      from_[c.column] = row;
    }
    column = nearestColumn();
    if (column < 0 || distance_[column] > loner_length) {
      column = loner == start ? -1 : column_[loner];
      length = loner_length;
      if (loner != start) column_[loner] = -1;
      break;
    }
    length = distance_[column];
    settled_[column] = 1;
    row = row_[column];
    if (row < 0) break;
    if (length + alone - row_price_[row] < loner_length) {
      loner_length = length + alone - row_price_[row];
      loner = row;
    }
  }
  raise(start, length);
  augment(start, column);
}

int Assignment::nearestColumn() const {
  int best = -1;
  for (const int column : reached_)
    if (!settled_[column] && (best < 0 || distance_[column] < distance_[best])) best = column;
  return best;
}

/// Keeps the promise of `prepare` for what the search has passed.
void Assignment::raise(int start, double length) {
  row_price_[start] += length;
  for (const int column : reached_) {
    if (!settled_[column] || distance_[column] >= length) continue;
    row_price_[row_[column]] += length - distance_[column];
    column_price_[column] -= length - distance_[column];
  }
}

/// Gives `column` to the row that reached it, that row's former column on to the next, and so on.
void Assignment::augment(int start, int column) {
  while (column >= 0) {
    const int row = from_[column], former = row == start ? -1 : column_[row];
    row_[column] = row;
    column_[row] = column;
    column = former;
  }
  for (const int touched : reached_) {
    from_[touched] = -1;
    settled_[touched] = 0;
  }
  reached_.clear();
}

}  // namespace field_fusion::core
