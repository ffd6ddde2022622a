// map (A), projected_map (B) -> [odds of both, occupied where either is] -> fused_map, fused_local_map
#include <pluginlib/class_list_macros.hpp>
#include <std_srvs/Empty.h>

#include "field_fusion/ros/fusion_flow.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class MapFusionNodelet : public StageNodelet<FusionStageParams> {
 public:
  MapFusionNodelet() : StageNodelet(Listen::kAlways) {}

 private:
  void onStart() override {
    onParams();
    fused_ = output<nav_msgs::OccupancyGrid>("fused_map", true);
    local_ = output<nav_msgs::OccupancyGrid>("fused_local_map");
    service<SaveMap>("save_fused_map", [this](auto& request, auto& answer) { flow_.save(request, answer); });
    service<std_srvs::Empty>("reset_fused_map", [this](auto&, auto&) { flow_.reset(); });
    auto& map = input<nav_msgs::OccupancyGrid>("map", [this](const auto& map) { flow_.addMap(*map), send(); });
    map.optional = true;  // no new one comes of a robot that stands
    input<nav_msgs::OccupancyGrid>("projected_map",
                                   [this](const auto& map) { flow_.addProjected(*map), send(); });
  }

  void onParams() override { flow_.setParams(params()); }
  void onTimeJump() override { flow_.reset(); }
  void onListener() override {
    if (flow_.hasMap()) fused_.publish(flow_.fused());
  }

  void send() {
    if (!flow_.isDue()) return;
    if (!fused_.unwanted()) fused_.publish(flow_.fused());
    if (local_.unwanted()) return;
    if (const auto local = flow_.local(tf())) local_.publish(local);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& s) override { flow_.describe(s); }

  FusionFlow flow_;
  Output<nav_msgs::OccupancyGrid> fused_, local_;
};
using MapFusionStage = Unloadable<MapFusionNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::MapFusionStage, nodelet::Nodelet)
