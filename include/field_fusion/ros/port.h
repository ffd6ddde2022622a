#pragma once
// The inputs and outputs of a stage, with what /diagnostics tells of each.
#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "field_fusion/core/base/latency.h"
#include "field_fusion/core/base/stamp_order.h"

namespace field_fusion {

/// Bad input by kind. The text of a fault is "kind: details"; kinds are few, so that counting them is
/// bounded.
class FaultLog {
 public:
  /// Counts the fault; true when it is time to write it to the log (each kind at most once in 5 s of wall
  /// time).
  bool add(const std::string& text);
  std::uint64_t total() const { return total_; }
  const std::map<std::string, std::uint64_t>& byKind() const { return by_kind_; }
  const std::string& last() const { return last_; }
  /// Seconds of wall time since the last fault, infinite when there was none.
  double age() const;

 private:
  std::map<std::string, std::uint64_t> by_kind_;
  std::map<std::string, ros::WallTime> logged_;
  std::string last_;
  ros::WallTime last_at_;
  std::uint64_t total_ = 0;
};

/// To be held while a topic is advertised or subscribed: where two threads do so at once, roscpp may link the
/// two ends twice, and every message comes double.
std::mutex& linkMutex();

/// What identifies one message: nodelets of one manager hand on the very same object.
struct MessageTrace {
  ros::Time stamp;
  const void* address = nullptr;
};

struct InputPort {
  std::string topic;
  std::function<std::shared_ptr<void>()> subscribe;
  std::shared_ptr<void> subscription;  ///< ends with its last holder
  core::RevisionOrder order;
  core::ClockAhead ahead;
  FaultLog faults;
  core::Latency latency;  ///< from arrival to the end of its processing
  MessageTrace last;
  ros::Time believed;  ///< stamp of the last message that was in order
  ros::WallTime last_arrival;
  std::uint64_t received = 0, processed = 0, skipped = 0;
  std::uint64_t missing = 0;   ///< gaps of header.seq: sent, but never arrived
  std::uint32_t last_seq = 0;  ///< 0: none yet
  std::uint32_t queue = 4;     ///< messages that roscpp keeps while the stage is busy
  bool optional = false;       ///< its silence is no fault
  bool deferred = false;       ///< a worker ends the processing by Stage::complete
};

struct OutputPort {
  ros::Publisher publisher;
  MessageTrace last;
  std::uint64_t published = 0;
};

/// Handle of a typed output. Publishing a pointer hands the object itself to nodelets of the same manager.
template <class Message>
class Output {
 public:
  Output() = default;
  explicit Output(OutputPort* port) : port_(port) {}

  /// Nobody listens: whatever is expensive to build need not be built.
  bool unwanted() const { return port_->publisher.getNumSubscribers() == 0; }

  void publish(const boost::shared_ptr<const Message>& message) {
    const auto* stamp = ros::message_traits::TimeStamp<Message>::pointer(*message);  // null: no header
    port_->last = {stamp ? *stamp : ros::Time(), message.get()};
    ++port_->published;
    port_->publisher.publish(message);
  }

 private:
  OutputPort* port_ = nullptr;
};

}  // namespace field_fusion
