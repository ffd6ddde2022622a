#pragma once
// Rows to columns at the least total cost.
#include <vector>

namespace field_fusion::core {

/// A row and a column that may be paired.
struct Candidate {
  int row = -1, column = -1;
  double cost = 0.0;
};

/// Optimal assignment by shortest augmenting paths (Jonker and Volgenant 1987) over the candidates alone: a
/// search never leaves the connected component that it starts in, so that the worst case is cubic in the
/// largest component. A row left alone costs `alone`: a pair is made where that lowers the total, or leaves
/// it equal. Keeps its buffers from call to call.
class Assignment {
 public:
  /// Candidates in rising order of rows, their costs finite. The column of each row, -1 for none; valid until
  /// the next call.
  const std::vector<int>& run(int rows, int columns, const std::vector<Candidate>& candidates, double alone);

 private:
  void prepare(int rows, int columns, const std::vector<Candidate>& candidates, double alone);
  void place(int row, const std::vector<Candidate>& candidates, double alone);
  int nearestColumn() const;
  void raise(int start, double length);
  void augment(int start, int column);

  std::vector<int> first_;         // of each row in the candidates, and the end
  std::vector<int> column_, row_;  // partners of rows and columns
  std::vector<double> row_price_, column_price_;
  std::vector<double> distance_;  // of columns from the row being placed
  std::vector<int> from_;         // the row by which a column was reached
  std::vector<char> settled_;
  std::vector<int> reached_;  // columns
};

}  // namespace field_fusion::core
