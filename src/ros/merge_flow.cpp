#include "field_fusion/ros/merge_flow.h"

#include <cmath>

#include "field_fusion/ros/scan_message.h"

namespace field_fusion {

void MergeFlow::setParams(const ScanMergeParams& params) {
  merger_.setParams(params.merge);
  level_.setParams(params.level);
  params_ = params;
  inputs_.resize(params.scans.size());
}

void MergeFlow::reset() {
  inputs_.assign(inputs_.size(), {});
  last_ = {};
}

bool MergeFlow::within(const Input& input, const ros::Time& stamp, double seconds) {
  return !input.header.stamp.isZero() && std::abs((stamp - input.header.stamp).toSec()) <= seconds;
}

bool MergeFlow::leads(std::size_t input, const ros::Time& stamp) const {
  for (std::size_t i = 0; i < input; ++i)
    if (within(inputs_[i], stamp, params_.silence)) return false;
  return stamp > last_;
}

boost::shared_ptr<sensor_msgs::LaserScan> MergeFlow::run(std::size_t input,
                                                         const sensor_msgs::LaserScan::ConstPtr& scan,
                                                         const TfCache& tf,
                                                         std::vector<std::string>& faults) {
  const ros::Time& stamp = scan->header.stamp;
  inputs_[input].scan = scanOf(*scan);
  inputs_[input].header = scan->header;
  faults.assign(inputs_.size(), "");
  if (!leads(input, stamp)) return nullptr;
  const auto T_plane_base = level_.send(stamp, tf);
  merger_.begin(params_.level.plane_height);
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    auto& in = inputs_[i];
    in.merged = false;
    if (within(in, stamp, params_.max_age)) try {
        merger_.add(in.scan, level_.sensor(T_plane_base, stamp, in.header, tf));
        in.merged = true;
      } catch (const std::runtime_error& e) {
        if (i == input) {
          in.header = {};  // what cannot be used must not lead: the others would wait for it
          throw;
        }
        faults[i] = e.what();
      }
  }
  last_ = stamp;
  return scanMessage(level_.header(stamp), merger_.result());
}

void MergeFlow::describe(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    status.add(params_.scans[i] + ": in the last result", inputs_[i].merged);
    if (!last_.isZero() && !inputs_[i].merged)
      status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "merged without " + params_.scans[i]);
  }
  const auto& counts = merger_.counts();
  status.add("last result: returns", counts.returns);
  status.add("last result: floor", counts.floor);
  status.add("last result: above the band", counts.above);
  status.add("last result: outside range and sector", counts.out_of_range);
  status.add("last result: merged", counts.merged);
}

}  // namespace field_fusion
