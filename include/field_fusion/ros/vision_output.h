#pragma once
// Obstacles as vision_msgs/Detection3DArray, where that package was there when this one was built
// (cmake/optional_messages.cmake). No other file depends on whether it was.
#include <string>
#include <vector>

#include "field_fusion/ObstacleArray.h"
#include "field_fusion/ros/port.h"
#ifdef FIELD_FUSION_VISION_MSGS
#include <vision_msgs/Detection3DArray.h>
#endif

namespace field_fusion {
#ifdef FIELD_FUSION_VISION_MSGS

/// The obstacles whose position is known. A class is its place in `class_names`, -1 where it is not there or
/// the obstacle has none; the score is that of the class, without class the probability that the body exists.
/// An unknown size is 0, because this message has no word for it.
boost::shared_ptr<vision_msgs::Detection3DArray> visionMessage(const ObstacleArray& obstacles,
                                                               const std::vector<std::string>& class_names);

class VisionOutput {
 public:
  /// `advertise` takes a null pointer to the type of the message and gives its output.
  template <class Advertise>
  void start(const Advertise& advertise) {
    output_ = advertise(static_cast<vision_msgs::Detection3DArray*>(nullptr));
  }
  void publish(const ObstacleArray& obstacles, const std::vector<std::string>& class_names) {
    if (!output_.unwanted()) output_.publish(visionMessage(obstacles, class_names));
  }

 private:
  Output<vision_msgs::Detection3DArray> output_;
};

#else

class VisionOutput {
 public:
  template <class Advertise>
  void start(const Advertise&) {}
  void publish(const ObstacleArray&, const std::vector<std::string>&) {}
};

#endif
}  // namespace field_fusion
