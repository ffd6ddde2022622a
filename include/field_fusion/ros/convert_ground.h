#pragma once
#include <boost/shared_ptr.hpp>

#include "field_fusion/GroundPlane.h"
#include "field_fusion/core/cloud/ground.h"

namespace field_fusion {

boost::shared_ptr<GroundPlane> groundMessage(const std_msgs::Header& header, const core::Ground& ground);

}  // namespace field_fusion
