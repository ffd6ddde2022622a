#pragma once
// What the stage tests share: publish until an answer or a deadline, and read /diagnostics.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <functional>
#include <map>
#include <string>

namespace field_fusion::test {

constexpr double kDeadline = 15.0;  // [s] of wall time

/// Spins until `holds`, calling `step` every 20 ms; false when the deadline passed.
inline bool spinUntil(
    const std::function<bool()>& holds, const std::function<void()>& step = [] {},
    double deadline = kDeadline) {
  const auto end = ros::WallTime::now() + ros::WallDuration(deadline);
  while (ros::WallTime::now() < end && ros::ok()) {
    ros::spinOnce();
    if (holds()) return true;
    step();
    ros::WallDuration(0.02).sleep();
  }
  return holds();
}

/// The same with a `step` that waits for its answer: called again only after a second without one.
inline bool askUntil(const std::function<bool()>& holds, const std::function<void()>& step) {
  ros::WallTime asked;
  return spinUntil(holds, [&] {
    if (ros::WallTime::now() - asked < ros::WallDuration(1.0)) return;
    asked = ros::WallTime::now();
    step();
  });
}

/// The last message of a topic, and how many there were.
template <class M>
class Received {
 public:
  explicit Received(const std::string& topic)
      : subscriber_(nh_.subscribe<M>(topic, 50,
                                     [this](const boost::shared_ptr<const M>& m) { last = m, ++count; })) {}
  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  void leave() { subscriber_.shutdown(); }

  boost::shared_ptr<const M> last;
  int count = 0;

 private:
  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;
};

/// An input of the stage under test: ready once the stage has subscribed.
template <class M>
class Sender {
 public:
  explicit Sender(const std::string& topic) : publisher_(nh_.advertise<M>(topic, 50)) {}
  bool connected() const { return publisher_.getNumSubscribers() > 0; }
  void send(const M& message) const { publisher_.publish(message); }

 private:
  ros::NodeHandle nh_;
  ros::Publisher publisher_;
};

/// The newest status of each node on /diagnostics.
class Diagnostics {
 public:
  Diagnostics() : subscriber_(nh_.subscribe("/diagnostics", 50, &Diagnostics::onArray, this)) {}

  /// Level 0..2 and summary of the status whose name begins with `node`.
  const diagnostic_msgs::DiagnosticStatus* of(const std::string& node) const {
    for (const auto& [name, status] : statuses_)
      if (name.find(node) != std::string::npos) return &status;
    return nullptr;
  }
  /// Whether there is one, with `words` in its summary.
  bool says(const std::string& node, const std::string& words) const {
    const auto* status = of(node);
    return status && status->message.find(words) != std::string::npos;
  }
  std::string value(const std::string& node, const std::string& key) const {
    if (const auto* status = of(node))
      for (const auto& entry : status->values)
        if (entry.key == key) return entry.value;
    return "";
  }

 private:
  void onArray(const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) statuses_[status.name] = status;
  }

  std::map<std::string, diagnostic_msgs::DiagnosticStatus> statuses_;
  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;
};

}  // namespace field_fusion::test
