#pragma once
// What all stages share: declared parameters, inputs that are checked and counted, lazy subscription,
// one error policy, one rule for time jumps, and /diagnostics.
#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <sensor_msgs/Image.h>

#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "field_fusion/ros/other_names.h"
#include "field_fusion/ros/port.h"
#include "field_fusion/ros/reconfigure.h"
#include "field_fusion/ros/stage_params.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

/// A message type that can arrive damaged overloads this with what is wrong ("kind: details").
template <class Message>
const std::string& faultOf(const Message&) {
  static const std::string none;
  return none;
}

/// Messages with a field `revision` may repeat a stamp: each revision is a series of its own.
template <class Message>
auto revisionOf(const Message& message, int) -> decltype(message.revision) {
  return message.revision;
}
template <class Message>
std::uint8_t revisionOf(const Message&, long) {
  return 0;
}

/// Base of every stage, without its parameters: derive from StageNodelet. All virtual functions and input
/// handlers run one at a time. What a handler throws drops that message: it is counted, logged and shown
/// in /diagnostics, and the next message is taken.
class Stage : public nodelet::Nodelet {
 protected:
  /// Listening: a stage with state always subscribes, any other only while somebody takes its outputs.
  enum class Listen { kLazy, kAlways };
  explicit Stage(Listen listen) : listen_(listen) {}

  virtual void declare(core::Params& params) = 0;
  virtual OtherNames others() const = 0;
  virtual void onStart() = 0;   ///< declare outputs, then inputs; throw to refuse to start
  virtual void onParams() {}    ///< live parameters have changed; throw to refuse the change
  virtual void onTimeJump() {}  ///< forget everything that depends on time
  virtual void onListener() {}  ///< somebody new takes a latched output, which may hold what is no longer so
  virtual void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper&) {}  ///< add keys

  template <class M>
  using Handler = std::function<void(const boost::shared_ptr<const M>&)>;
  template <class M>
  using Ready = std::function<bool(const M&)>;

  /// An output on a topic relative to the stage's namespace, or to its own name after "~". A latched one gives its last
  /// message to who comes later.
  template <class M>
  Output<M> output(const std::string& topic, bool latched = false) {
    const ros::SubscriberStatusCallback left = [this](const ros::SingleSubscriberPublisher&) { onSubscribersChanged(false); };
    const ros::SubscriberStatusCallback came = [this, latched](const ros::SingleSubscriberPublisher&) {
      onSubscribersChanged(latched);
    };
    auto& port = outputs_.emplace_back();
    const std::lock_guard<std::mutex> linking(linkMutex());
    auto& nh = topic[0] == '~' ? getPrivateNodeHandle() : getNodeHandle();
    port.publisher = nh.template advertise<M>(topic.substr(topic[0] == '~'), kQueue, came, left, {}, latched);
    return Output<M>(&port);
  }

  /// An input on a topic relative to the stage's namespace. With `ready`, a message waits until that holds,
  /// at most `hold_limit`, and is then handled all the same: the handler says what was missing.
  template <class M>
  InputPort& input(const std::string& topic, Handler<M> handler, Ready<M> ready = nullptr) {
    auto& port = addInput(topic);
    auto receive = receiver<M>(port, std::move(handler), std::move(ready));
    port.subscribe = [this, topic, &port, receive]() -> std::shared_ptr<void> {
      return std::make_shared<ros::Subscriber>(
          getNodeHandle().template subscribe<M>(topic, port.queue, receive));
    };
    return port;
  }

  /// An input of images in whatever way `~image_transport` says; raw images come as the pointer itself.
  InputPort& imageInput(const std::string& topic, Handler<sensor_msgs::Image> handler,
                        Ready<sensor_msgs::Image> ready);

  /// Ends all callbacks and waits for the one that runs. A manager unloads a stage while messages come in,
  /// and the members of a derived class go before those of this one: Unloadable calls it in time.
  void stop();

  /// Counts and logs a fault of an input.
  void fault(InputPort& port, const ros::Time& stamp, const std::string& text);

  /// A service relative to the stage's namespace, handled in turn with the messages. What the handler throws is logged, and
  /// the call fails.
  template <class S>
  void service(const std::string& name, std::function<void(typename S::Request&, typename S::Response&)> handler) {
    const auto call = [this, name, handler](typename S::Request& request, typename S::Response& response) {
      const std::lock_guard<std::mutex> lock(mutex_);
      return serve(name, [&] { handler(request, response); });
    };
    services_.push_back(getNodeHandle().template advertiseService<typename S::Request, typename S::Response>(name, call));
  }

  /// Calls `work` every so often (wall time), in turn with the handlers; what it throws is logged.
  ros::WallTimer every(double seconds, std::function<void()> work);

  /// Ends the work on a message of a deferred input in the stage's own turn.
  void count(InputPort& port, ros::WallTime arrival);

  /// Ends, in a worker's thread, the work on a message of a deferred input: `compute` runs beside the
  /// handlers, `publish` takes its result and runs like one of them. What either throws drops the message.
  template <class Compute, class Publish>
  void complete(InputPort& port, const ros::Time& stamp, ros::WallTime arrival, Compute compute,
                Publish publish) {
    decltype(compute()) result{};
    std::exception_ptr failure;
    try {
      result = compute();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto rest = [&] { failure ? std::rethrow_exception(failure) : publish(result); };
    if (!stopped_ && attempt(port, stamp, rest)) count(port, arrival);
  }

  /// The buffer that all stages of the process share.
  TfCache& tf() { return *tf_; }

 private:
  struct Arrival {
    ros::WallTime at;
    MessageTrace message;
    std::function<bool()> ready;
    std::function<void()> handle;
    std::uint32_t seq = 0;
    std::uint8_t revision = 0;
  };
  struct Held {
    InputPort* port;
    Arrival arrival;
  };
  static constexpr std::uint32_t kQueue = 4;
  static constexpr std::size_t kMaxHeld = 32;

  /// What a subscription calls: the checked entry of an input.
  template <class M>
  Handler<M> receiver(InputPort& port, Handler<M> handler, Ready<M> ready) {
    return [this, &port, handler, ready](const boost::shared_ptr<const M>& message) {
      Arrival arrival{
          ros::WallTime::now(), {message->header.stamp, message.get()}, nullptr, [handler, message] {
            handler(message);
          }};
      arrival.seq = message->header.seq;
      arrival.revision = revisionOf(*message, 0);
      if (ready) arrival.ready = [ready, message] { return ready(*message); };
      onArrival(port, std::move(arrival), faultOf(*message));
    };
  }
  InputPort& addInput(const std::string& topic);
  void onInit() final;
  void start();
  void onSubscribersChanged(bool wants_latched);
  static std::shared_ptr<void> link(const InputPort& port);
  void updateSubscriptions();
  void onArrival(InputPort& port, Arrival arrival, const std::string& damage);
  bool inOrder(InputPort& port, const Arrival& arrival);
  void jump(InputPort& port, const ros::Time& before, const ros::Time& stamp);
  void handle(InputPort& port, const Arrival& arrival);
  bool attempt(InputPort& port, const ros::Time& stamp, const std::function<void()>& work);
  bool serve(const std::string& name, const std::function<void()>& work);
  bool waits(const InputPort& port) const;
  static bool isReady(const Arrival& arrival);
  void release();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void announceRefusal(const std::string& reason);

  const Listen listen_;
  std::mutex mutex_;
  StageParams stage_params_;
  core::Params declared_;
  std::deque<InputPort> inputs_;  // deques: ports never move
  std::deque<OutputPort> outputs_;
  std::deque<Held> held_;
  std::shared_ptr<TfCache> tf_;
  std::unique_ptr<Reconfigure> reconfigure_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::WallTimer> timers_;
  ros::WallTimer hold_timer_;
  std::uint64_t time_jumps_ = 0;
  bool subscribed_ = false;
  bool stopped_ = false;
};

/// A stage with its parameters. A nodelet file derives from this and implements onStart and its handlers.
template <class P>
class StageNodelet : public Stage {
 protected:
  explicit StageNodelet(Listen listen = Listen::kLazy) : Stage(listen) {}
  const P& params() const { return params_; }

 private:
  void declare(core::Params& params) final { params_.declare(params); }
  OtherNames others() const final { return otherNamesOf<P>(0); }
  P params_;
};

/// What a nodelet file exports: the stage, with its callbacks ended before its members go.
template <class S>
class Unloadable final : public S {
 public:
  ~Unloadable() override { this->stop(); }
};

}  // namespace field_fusion
