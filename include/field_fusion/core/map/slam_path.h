#pragma once
// Paths of particles: a tree, because particles have their past in common.
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "field_fusion/core/base/pose2.h"

namespace field_fusion::core {

struct PathNode : boost::intrusive_ref_counter<PathNode> {
  using Pointer = boost::intrusive_ptr<PathNode>;

  PathNode(const StampedPose2& at, Pointer before) : at(at), before(std::move(before)) {}
  /// One by one: a chain of hours would else overflow the stack.
  ~PathNode() {
    while (before && before->use_count() == 1) before = Pointer(std::move(before->before));
  }

  StampedPose2 at;
  Pointer before;
};

/// Forgets what lies more than `length` nodes before `last`, for all whose path goes through there.
inline void cutPath(PathNode* last, int length) {
  for (; last && length > 1; --length) last = last->before.get();
  if (last) last->before.reset();
}

/// From the first to `last`.
inline std::vector<StampedPose2> pathTo(const PathNode* last) {
  std::vector<StampedPose2> out;
  for (const PathNode* node = last; node; node = node->before.get()) out.push_back(node->at);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace field_fusion::core
