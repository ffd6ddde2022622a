#include <algorithm>
#include <tuple>

#include "field_fusion/core/detect/yolo.h"

namespace field_fusion::core {
namespace {

bool ranksBefore(const Detection& a, const Detection& b) {
  const auto key = [](const Detection& d) {
    return std::make_tuple(-d.score, d.class_id, d.box.x_min, d.box.y_min, d.box.x_max, d.box.y_max);
  };
  return key(a) < key(b);
}

}  // namespace

void suppressOverlaps(std::vector<Detection>& detections, double iou, int max_detections) {
  std::sort(detections.begin(), detections.end(), ranksBefore);
  const auto most = static_cast<std::size_t>(max_detections);
  const auto limit = static_cast<float>(iou);
  std::size_t kept = 0;  // the survivors are gathered at the front
  for (std::size_t i = 0; i < detections.size() && kept < most; ++i) {
    const Detection candidate = detections[i];
    const bool covered =
        std::any_of(detections.begin(), detections.begin() + kept, [&](const Detection& better) {
          return better.class_id == candidate.class_id &&
                 intersectionOverUnion(better.box, candidate.box) > limit;
        });
    if (!covered) detections[kept++] = candidate;
  }
  detections.resize(kept);
}

}  // namespace field_fusion::core
