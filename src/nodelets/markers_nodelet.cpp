// obstacles -> [draw] -> markers
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/ros/convert.h"
#include "field_fusion/ros/markers.h"
#include "field_fusion/ros/stage.h"

namespace field_fusion {

class MarkersNodelet : public StageNodelet<MarkersParams> {
  void onStart() override {
    onParams();
    markers_ = output<visualization_msgs::MarkerArray>("markers");
    input<ObstacleArray>("obstacles", [this](const auto& obstacles) {
      check(*obstacles);
      if (obstacles->provisional) return;  // drawn in turn with the last word, it would flicker
      markers_.publish(drawer_.draw(*obstacles));
    });
  }

  void onParams() override { drawer_.setParams(params()); }

  ObstacleMarkers drawer_;
  Output<visualization_msgs::MarkerArray> markers_;
};
using MarkersStage = Unloadable<MarkersNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::MarkersStage, nodelet::Nodelet)
