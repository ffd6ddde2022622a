// Boards to calibrate cameras with.
#include "builder.h"
#include "kinds.h"
#include "materials.h"

namespace field_fusion::core::sim {
namespace {

/// A print on a plate. Its dark squares are bodies, so that their borders are as sharp as a print's; a texture begins
/// anywhere.
Model checkerboard(const ShapeParams& p) {
  const Extent e(p);
  constexpr float kPrint = 2e-4f;  // [m] stands out so little that no ray meets its side
  const int columns = static_cast<int>(of(p, "columns")) + 1, rows = static_cast<int>(of(p, "rows")) + 1;
  const float margin = of(p, "margin");
  const float wide = (2 * e.y - 2 * margin) / static_cast<float>(columns);
  const float high = (e.h - 2 * margin) / static_cast<float>(rows);
  Builder builder;
  builder.use(matt(kWhite, 0.8f), "plate").box({-e.x, -e.y, 0}, {e.x - kPrint, e.y, e.h});
  builder.use(matt(kBlack, 0.1f), "print");
  for (int row = 0; row < rows; ++row)
    for (int column = row % 2; column < columns; column += 2) {
      const float y = -e.y + margin + wide * static_cast<float>(column);
      const float z = margin + high * static_cast<float>(row);
      builder.box({0.f, y, z}, {e.x, y + wide, z + high});
    }
  return builder.build();
}

}  // namespace

ShapeKinds boardShapes() {
  return {
      {"checkerboard",
       {"a board to calibrate with; its print faces x and has `columns` x `rows` inner corners within a white `margin`",
        {{"length", 0.02}, {"width", 1}, {"height", 0.8}, {"margin", 0.05}, {"columns", 8}, {"rows", 6}},
        checkerboard}},
  };
}

}  // namespace field_fusion::core::sim
