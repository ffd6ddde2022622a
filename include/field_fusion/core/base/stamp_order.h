#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace field_fusion::core {

/// Tells for each stamp of one input whether time went on, stumbled or jumped back (a looping bag).
class StampOrder {
 public:
  enum class Verdict { kNewer, kOutOfOrder, kTimeJump };

  /// Older than the last by more than this is a jump; less, or equal, is out of order.
  static constexpr std::int64_t kJumpNs = 1'000'000'000;

  /// So many late stamps in a row that rise among themselves are a jump too: a bag shorter than kJumpNs
  /// loops.
  static constexpr int kJumpRun = 5;

  /// A stamp that is out of order leaves the last one as it was.
  Verdict check(std::int64_t stamp_ns) {
    const bool late = last_ns_ && stamp_ns <= *last_ns_;
    run_ = !late ? 0 : stamp_ns > late_ns_ ? run_ + 1 : 1;
    late_ns_ = stamp_ns;
    if (late && *last_ns_ - stamp_ns <= kJumpNs && run_ < kJumpRun) return Verdict::kOutOfOrder;
    last_ns_ = stamp_ns;
    run_ = 0;
    return late ? Verdict::kTimeJump : Verdict::kNewer;
  }
  void reset() { last_ns_.reset(), run_ = 0; }

 private:
  std::optional<std::int64_t> last_ns_;
  std::int64_t late_ns_ = 0;  // the last late stamp
  int run_ = 0;               // late stamps in a row, each newer than the one before
};

/// The same for an input whose messages come in revisions: each revision is a series of its own, because the
/// first of an instant comes before the second of an earlier one. A jump of one starts all anew.
class RevisionOrder {
 public:
  StampOrder::Verdict check(std::int64_t stamp_ns, std::uint8_t revision) {
    const auto verdict = order_[revision].check(stamp_ns);
    if (verdict == StampOrder::Verdict::kTimeJump) {
      reset();
      order_[revision].check(stamp_ns);
    }
    return verdict;
  }
  void reset() { order_.clear(); }

 private:
  std::map<std::uint8_t, StampOrder> order_;
};

/// Tells stamps of one input that run ahead of the clock by mistake from those of a sender whose clock runs ahead steadily:
/// such a stamp is believed only where the one before was as far ahead. Believed by mistake, one of them would make all
/// that follow look like a jump back in time.
class ClockAhead {
 public:
  static constexpr double kMost = 1.0;  ///< [s]

  /// Seconds by which the stamp is ahead; 0 where it is to be believed, or nothing is known of the clock (0).
  double check(std::int64_t stamp_ns, std::int64_t clock_ns) {
    if (clock_ns == 0) return 0.0;
    const double ahead = 1e-9 * static_cast<double>(stamp_ns - clock_ns);
    const bool believed = ahead <= kMost || (last_ && std::abs(ahead - *last_) <= kMost);
    last_ = ahead;
    return believed ? 0.0 : ahead;
  }
  void reset() { last_.reset(); }

 private:
  std::optional<double> last_;  // [s] of the stamp before
};

}  // namespace field_fusion::core
