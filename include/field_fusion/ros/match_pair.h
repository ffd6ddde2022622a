#pragma once
#include <string>

#include "field_fusion/ObstacleArray.h"
#include "field_fusion/ros/pair_sync.h"
#include "field_fusion/ros/tf_cache.h"

namespace field_fusion {

/// The obstacles of a pair whose messages passed `check`, in the frame and with the stamp of the clusters;
/// revision 0 where the camera said nothing. `fault` tells why the detections have no place, or is empty:
/// without a transform at their stamp they stay what the image alone shows.
boost::shared_ptr<ObstacleArray> matchPair(core::Matcher& matcher, const PairSync::Pair& pair,
                                           const TfCache& tf, std::string& fault);

}  // namespace field_fusion
