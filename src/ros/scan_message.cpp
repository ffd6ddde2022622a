#include "field_fusion/ros/scan_message.h"

#include <boost/make_shared.hpp>

#include <stdexcept>

namespace field_fusion {

core::Scan scanOf(const sensor_msgs::LaserScan& message) {
  core::Scan out;
  out.angle_min = message.angle_min;
  out.angle_increment = message.angle_increment;
  out.time_increment = message.time_increment;
  out.scan_time = message.scan_time;
  out.range_min = message.range_min;
  out.range_max = message.range_max;
  out.ranges = message.ranges;
  out.intensities = message.intensities;
  const auto fault = faultOf(out);
  if (!fault.empty()) throw std::runtime_error(fault);
  return out;
}

boost::shared_ptr<sensor_msgs::LaserScan> scanMessage(const std_msgs::Header& header,
                                                      const core::Scan& scan) {
  auto out = boost::make_shared<sensor_msgs::LaserScan>();
  out->header = header;
  out->angle_min = static_cast<float>(scan.angle_min);
  out->angle_increment = static_cast<float>(scan.angle_increment);
  out->angle_max =
      static_cast<float>(scan.ranges.empty() ? scan.angle_min : scan.angle(scan.ranges.size() - 1));
  out->time_increment = static_cast<float>(scan.time_increment);
  out->scan_time = static_cast<float>(scan.scan_time);
  out->range_min = static_cast<float>(scan.range_min);
  out->range_max = static_cast<float>(scan.range_max);
  out->ranges = scan.ranges;
  out->intensities = scan.intensities;
  return out;
}

}  // namespace field_fusion
