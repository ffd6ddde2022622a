#pragma once
// Laser scans to and from what core works on.
#include <sensor_msgs/LaserScan.h>

#include "field_fusion/core/scan/scan.h"

namespace field_fusion {

/// Throws std::runtime_error "scan damaged: ..." with what makes it unusable.
core::Scan scanOf(const sensor_msgs::LaserScan& message);

boost::shared_ptr<sensor_msgs::LaserScan> scanMessage(const std_msgs::Header& header, const core::Scan& scan);

}  // namespace field_fusion
