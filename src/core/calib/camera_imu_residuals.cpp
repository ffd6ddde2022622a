#include "camera_imu_residuals.h"

#include <ceres/autodiff_cost_function.h>

namespace field_fusion::core {

ceres::CostFunction* costOf(const PictureResidual& residual) {
  using Cost = ceres::AutoDiffCostFunction<PictureResidual, ceres::DYNAMIC, 6, 6, 6, 6, 6, 6, 6, 1>;
  return new Cost(new PictureResidual(residual), static_cast<int>(2 * residual.corners.size()));
}

ceres::CostFunction* costOf(const GyroResidual& residual) {
  return new ceres::AutoDiffCostFunction<GyroResidual, 3, 6, 6, 6, 6, 6, 6, 6, 6>(new GyroResidual(residual));
}

ceres::CostFunction* costOf(const AccelResidual& residual) {
  return new ceres::AutoDiffCostFunction<AccelResidual, 3, 6, 6, 6, 6, 6, 6, 6, 6, 2>(
      new AccelResidual(residual));
}

ceres::CostFunction* costOf(const BiasWalk& residual) {
  return new ceres::AutoDiffCostFunction<BiasWalk, 6, 6, 6>(new BiasWalk(residual));
}

}  // namespace field_fusion::core
