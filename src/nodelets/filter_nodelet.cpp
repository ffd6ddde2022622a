// points -> [filter] -> points_filtered: angle, range, box, body, voxel
#include <boost/make_shared.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "field_fusion/core/cloud/filter.h"
#include "field_fusion/ros/cloud_message.h"
#include "field_fusion/ros/stage.h"
#include "field_fusion/ros/stage_declarations.h"

namespace field_fusion {

class FilterNodelet : public StageNodelet<FilterStageParams> {
  void onStart() override {
    onParams();
    kept_ = output<CloudMessage>("points_filtered");
    input<CloudMessage>(
        "points", [this](const auto& cloud) { onCloud(*cloud); },
        [this](const auto& cloud) { return tf().has(params().box_frame, cloud.header); });
  }

  void onParams() override { filter_.setParams(params().filter); }

  void onCloud(const CloudMessage& cloud) {
    auto kept = boost::make_shared<CloudMessage>();
    kept->header = cloud.header;
    kept->points.reserve(cloud.points.size());
    const auto T_box_sensor = tf().lookup(params().box_frame, cloud.header);
    counts_ = filter_.run(cloud.points, kept->points, T_box_sensor);
    kept_.publish(kept);
  }

  void onDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    status.add("last cloud: points in", counts_.in);
    status.add("last cloud: points kept", counts_.kept);
    status.add("last cloud: not finite", counts_.non_finite);
    status.add("last cloud: outside the angle", counts_.angle);
    status.add("last cloud: outside the range", counts_.range);
    status.add("last cloud: outside the box", counts_.box);
    status.add("last cloud: on the body", counts_.body);
    status.add("last cloud: merged in voxels", counts_.merged);
  }

  core::Filter filter_;
  core::FilterCounts counts_;
  Output<CloudMessage> kept_;
};
using FilterStage = Unloadable<FilterNodelet>;

}  // namespace field_fusion

PLUGINLIB_EXPORT_CLASS(field_fusion::FilterStage, nodelet::Nodelet)
