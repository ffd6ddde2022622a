#pragma once
// What the benchmarks of the grid SLAM share: runs over a log, parameters from the command line.
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "field_fusion/core/map/grid_slam.h"
#include "figure.h"

namespace field_fusion::bench {

/// One scan of a log. T_odom_base and the stamp are those of the scan.
struct LogScan {
  std::int64_t stamp_ns = 0;
  core::SlamScan points;
  core::Pose2 odometry;
};

/// "NAME=VALUE" into a parameter that is a number.
inline void setParam(core::GridSlamParams& params, const std::string& text) {
  const std::size_t at = text.find('=');
  const core::Params declared = core::declarationOf(params);
  const core::Param* param = declared.find(text.substr(0, at));
  if (!param || at == std::string::npos) throw std::invalid_argument(text + " sets no parameter");
  const double value = std::stod(text.substr(at + 1));
  if (std::holds_alternative<int>(param->get()))
    param->set(static_cast<int>(value));
  else
    param->set(value);
}

struct SlamRun {
  std::vector<core::StampedPose2> poses;  ///< of every scan: between those taken in, odometry goes on
  std::vector<double> cost_ms;            ///< of each scan that was taken in: CPU time of this thread
  double effective = 0.0;                 ///< mean N_eff
};

/// The best path at the end. Costs are whole where `params.threads` is 1.
inline SlamRun runSlam(core::GridSlam& slam, const std::vector<LogScan>& log) {
  SlamRun out;
  std::vector<core::Pose2> since;  // of each scan, from the one taken in before
  std::vector<std::size_t> node;
  core::Pose2 taken;
  std::size_t count = 0;
  for (const LogScan& scan : log) {
    auto outcome = core::GridSlam::Outcome::kSkipped;
    const double ms = costMs([&] { outcome = slam.process(scan.points, scan.odometry, scan.stamp_ns); });
    if (outcome == core::GridSlam::Outcome::kProcessed) {
      out.cost_ms.push_back(ms), out.effective += slam.effective();
      taken = scan.odometry, ++count;
    }
    since.push_back(core::between(taken, scan.odometry)), node.push_back(count);
  }
  const auto path = core::pathTo(slam.best().path.get());
  for (std::size_t i = 0; i < log.size(); ++i)
    if (node[i] > 0) out.poses.push_back({log[i].stamp_ns, path.at(node[i] - 1).pose * since[i]});
  out.effective /= static_cast<double>(std::max<std::size_t>(1, count));
  return out;
}

}  // namespace field_fusion::bench
