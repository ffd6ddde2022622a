#pragma once
// Opening a bag, for tools.
#include <rosbag/bag.h>

#include <stdexcept>
#include <string>

namespace field_fusion {

/// Throws std::runtime_error with the name of a file that is no bag.
inline void openBag(rosbag::Bag& bag, const std::string& file) try {
  bag.open(file);
} catch (const rosbag::BagException& e) {
  throw std::runtime_error(file + " is no bag that can be read: " + e.what());
}

}  // namespace field_fusion
