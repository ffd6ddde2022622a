#pragma once
// A bag in the making, and the messages that describe a sensor set-up that does not move.
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <boost/make_shared.hpp>

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/detect/bearing.h"

namespace field_fusion {

/// Writes `file` under the name FILE.part until `finish`; without that, nothing is left of it. Several that
/// write the same file at once have parts of their own (FILE.2.part ...); the last to finish gives the file.
class Recording {
 public:
  /// Throws rosbag::BagException where the file cannot be written, std::runtime_error where that name is no
  /// plain file's.
  explicit Recording(const std::string& file);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// Recorded as received at its own stamp.
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    bag_->write(topic, message.header.stamp, message);
  }

  /// Recorded as received at `time`; `latched`: whoever joins the playback late gets it too.
  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message, bool latched) {
    if (!latched) return bag_->write(topic, time, message);
    const auto header = boost::make_shared<ros::M_string>();
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    (*header)["latching"] = "1";
    bag_->write(topic, time, message, header);
  }

  /// On `/tf_static`, latched as its publishers do.
  void writeStatic(const std::vector<geometry_msgs::TransformStamped>& transforms);

  void finish();

 private:
  std::string file_, part_;
  std::unique_ptr<rosbag::Bag> bag_;
  bool finished_ = false;
};

/// Where `child` stands in `parent`: T_parent_child.
geometry_msgs::TransformStamped transformMessage(const ros::Time& stamp, const std::string& parent,
                                                 const std::string& child,
                                                 const core::Transform& T_parent_child);

/// Of a camera without distortion.
sensor_msgs::CameraInfo cameraInfo(const std_msgs::Header& header, const core::Pinhole& camera,
                                   cv::Size image);

}  // namespace field_fusion
