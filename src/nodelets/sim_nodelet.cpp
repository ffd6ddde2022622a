// a world -> [sensors] -> the topics of each mount, truth/..., /tf, /clock
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/sim_player.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class SimNodelet : public StageNodelet<SimNodeParams> {
 public:
  SimNodelet() : StageNodelet(Listen::kAlways) {}

 private:
  void onStart() override { player_ = std::make_unique<SimPlayer>(getNodeHandle(), params()); }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    if (const std::string fault = player_->fault(); !fault.empty())
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::ERROR, fault);
    if (player_->finished()) status.mergeSummary(diagnostic_msgs::DiagnosticStatus::OK, "its seconds are over");
    status.add("sim: time [s]", player_->time());
    status.add("sim: simulated over real time", player_->speed());
  }

  std::unique_ptr<SimPlayer> player_;
};
using SimStage = Unloadable<SimNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::SimStage, nodelet::Nodelet)
