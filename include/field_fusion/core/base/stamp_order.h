#pragma once
#include <cstdint>
#include <optional>

namespace field_fusion::core {

/// Tells for each stamp of one input whether time went on, stumbled or jumped back (a looping bag).
class StampOrder {
 public:
  enum class Verdict { kNewer, kOutOfOrder, kTimeJump };

  /// Older than the last by more than this is a jump; less, or equal, is out of order.
  static constexpr std::int64_t kJumpNs = 1'000'000'000;

  /// A stamp that is out of order leaves the last one as it was.
  Verdict check(std::int64_t stamp_ns) {
    if (last_ns_ && stamp_ns <= *last_ns_ && *last_ns_ - stamp_ns <= kJumpNs) return Verdict::kOutOfOrder;
    const bool jumped = last_ns_ && stamp_ns < *last_ns_;
    last_ns_ = stamp_ns;
    return jumped ? Verdict::kTimeJump : Verdict::kNewer;
  }
  void reset() { last_ns_.reset(); }

 private:
  std::optional<std::int64_t> last_ns_;
};

}  // namespace field_fusion::core
