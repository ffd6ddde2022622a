#pragma once
// Declared parameters to and from the parameter server.
#include <ros/node_handle.h>

#include "field_fusion/core/base/params.h"
#include "field_fusion/ros/other_names.h"

namespace field_fusion {

/// Sets every declared parameter that stands in the namespace of `nh`. Throws std::invalid_argument with
/// ALL faults in one text: wrong types, values out of range, broken rules, keys that nobody declared. Returns the keys
/// that are accepted but mean nothing.
std::vector<std::string> loadParams(const ros::NodeHandle& nh, const core::Params& params, const OtherNames& others = {});

/// Writes the current values to the parameter server, so that it tells what is in force.
void storeParams(const ros::NodeHandle& nh, const core::Params& params);

}  // namespace field_fusion
