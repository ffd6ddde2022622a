#pragma once
// The voxel map as octomap_msgs/Octomap, where that package was there when this one was built
// (cmake/optional_messages.cmake). No other file depends on whether it was.
#include <std_msgs/Header.h>

#include "field_fusion/core/map/voxel_map.h"
#include "field_fusion/ros/port.h"
#ifdef FIELD_FUSION_OCTOMAP_MSGS
#include <octomap_msgs/Octomap.h>
#endif

namespace field_fusion {
#ifdef FIELD_FUSION_OCTOMAP_MSGS

/// `binary`: free and occupied alone, as in a .bt file; else all log-odds, as in a .ot file.
boost::shared_ptr<octomap_msgs::Octomap> octomapMessage(const std_msgs::Header& header,
                                                        const core::VoxelMap& map, bool binary);

/// Topics by the names that octomap_server gives them.
class OctomapOutput {
 public:
  /// `advertise` takes a null pointer to the type of the message and a topic, and gives its output.
  template <class Advertise>
  void start(const Advertise& advertise) {
    binary_ = advertise(static_cast<octomap_msgs::Octomap*>(nullptr), "octomap_binary");
    full_ = advertise(static_cast<octomap_msgs::Octomap*>(nullptr), "octomap_full");
  }
  bool unwanted() const { return binary_.unwanted() && full_.unwanted(); }
  void publish(const std_msgs::Header& header, const core::VoxelMap& map) {
    if (!binary_.unwanted()) binary_.publish(octomapMessage(header, map, true));
    if (!full_.unwanted()) full_.publish(octomapMessage(header, map, false));
  }

 private:
  Output<octomap_msgs::Octomap> binary_, full_;
};

#else

class OctomapOutput {
 public:
  template <class Advertise>
  void start(const Advertise&) {}
  bool unwanted() const { return true; }
  void publish(const std_msgs::Header&, const core::VoxelMap&) {}
};

#endif
}  // namespace field_fusion
