#pragma once
// A simulation in real time: publishes its messages and /clock from a thread of its own.
#include <ros/node_handle.h>

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "field_fusion/ros/sim_run.h"

namespace field_fusion {

class SimPlayer {
 public:
  /// Throws as SimRun.
  SimPlayer(ros::NodeHandle node, const SimNodeParams& params);
  ~SimPlayer();

  double time() const { return time_; }    ///< [s] simulated since the start
  double speed() const { return speed_; }  ///< simulated over real time in the last second
  bool finished() const { return finished_; }  ///< its seconds are over
  std::string fault() const;               ///< why it ended early; empty: it did not

 private:
  void play();
  void playOnce(SimRun& run);
  void publish(const SimOutput& output);
  void tellTime(double time);

  ros::NodeHandle node_;
  SimNodeParams params_;
  std::map<std::string, ros::Publisher> publishers_;
  ros::Publisher clock_;
  std::unique_ptr<SimRun> run_;
  std::atomic<bool> stop_{false}, finished_{false};
  std::atomic<double> time_{0.0}, speed_{0.0};
  mutable std::mutex mutex_;
  std::string fault_;
  std::thread thread_;
};

}  // namespace field_fusion
