#pragma once
// From messages of some scans to scans of all of them.
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <sensor_msgs/LaserScan.h>

#include <vector>

#include "field_fusion/core/scan/merge.h"
#include "field_fusion/ros/level_frame.h"

namespace field_fusion {

struct ScanMergeParams {
  std::vector<std::string> scans{"scan", "depth_scan"};
  double max_age = 0.2;
  double silence = 0.5;
  core::MergeParams merge;
  LevelParams level{"scan_plane"};

  void declare(core::Params& p) {
    p.texts("scans", scans, core::When::kStart,
            "Topics of the scans. The first gives the stamps; while it is silent, the next does.");
    p.number("max_age", max_age, {0.0, 10.0}, "s", core::When::kLive,
             "Scans farther apart do not go together.");
    p.number(
        "silence", silence, {0.01, 100.0}, "s", core::When::kLive,
        "A scanner whose last stamp is older no longer gives the stamps; above its period and duration.");
    merge.declare(p);
    level.declare(p);
    p.rule([this] { return !scans.empty(); }, "scans must name a topic");
  }
};

class MergeFlow {
 public:
  /// Throws std::invalid_argument with every fault of the parameters.
  void setParams(const ScanMergeParams& params);
  bool ready(const std_msgs::Header& header, const TfCache& tf) const { return level_.ready(header, tf); }

  /// Takes a scan of one of the inputs. With its stamp, that scan and the newest of the others, carried to
  /// that instant; null where another input gives the stamps. What is wrong with a partner is in `faults`,
  /// one an input; it is left out. Throws std::runtime_error "scan damaged: ..." or where a transform is
  /// missing.
  boost::shared_ptr<sensor_msgs::LaserScan> run(std::size_t input,
                                                const sensor_msgs::LaserScan::ConstPtr& scan,
                                                const TfCache& tf, std::vector<std::string>& faults);

  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void reset();

 private:
  struct Input {
    core::Scan scan;
    std_msgs::Header header;  // stamp 0: none yet
    bool merged = false;      // in the last result
  };
  static bool within(const Input& input, const ros::Time& stamp, double seconds);
  bool leads(std::size_t input, const ros::Time& stamp) const;

  ScanMergeParams params_;
  LevelFrame level_;
  core::ScanMerger merger_;
  std::vector<Input> inputs_;
  ros::Time last_;  // stamp that went out
};

}  // namespace field_fusion
