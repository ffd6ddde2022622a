#include "field_fusion/ros/stage_declarations.h"

#include "field_fusion/core/match/match.h"
#include "field_fusion/ros/cloud_flow.h"
#include "field_fusion/ros/costmap_feed.h"
#include "field_fusion/ros/depth_scan_flow.h"
#include "field_fusion/ros/fusion_flow.h"
#include "field_fusion/ros/markers.h"
#include "field_fusion/ros/merge_flow.h"
#include "field_fusion/ros/scan_flow.h"
#include "field_fusion/ros/sim_params.h"
#include "field_fusion/ros/slam_params.h"
#include "field_fusion/ros/stage_params.h"
#include "field_fusion/ros/voxel_flow.h"

namespace field_fusion {
namespace {

template <class P>
StageDeclaration declaration(const char* name) {
  return {name, [](const std::function<void(const core::Params&)>& use) {
            P own;
            StageParams common;
            core::Params params;
            own.declare(params);
            common.declare(params);
            use(params);
          }, otherNamesOf<P>(0)};
}

}  // namespace

const std::vector<StageDeclaration>& stageDeclarations() {
  static const std::vector<StageDeclaration> all{
      declaration<DeskewScanParams>("deskew_scan"),    declaration<DeskewCloudParams>("deskew_cloud"),
      declaration<DepthScanStageParams>("depth_scan"), declaration<ScanMergeParams>("scan_merge"),
      declaration<FilterStageParams>("filter"),        declaration<GroundStageParams>("ground"),
      declaration<core::ClusterParams>("cluster"),     declaration<core::DetectParams>("detect"),
      declaration<core::MatchParams>("match"),         declaration<MarkersParams>("markers"),
      declaration<CostmapParams>("costmap"),           declaration<SlamStageParams>("grid_slam"),
      declaration<VoxelStageParams>("voxel_map"),      declaration<FusionStageParams>("map_fusion"),
      declaration<SimNodeParams>("sim"),
  };
  return all;
}

}  // namespace field_fusion
