#pragma once
// Live change of declared parameters over the dynamic_reconfigure protocol, without a .cfg file.
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <mutex>

#include "field_fusion/core/base/params.h"

namespace field_fusion {

/// Serves the live parameters to dynparam and rqt_reconfigure. A request is taken whole or refused whole,
/// with the reason logged; what is taken is written to the parameter server.
class Reconfigure {
 public:
  /// `params` must outlive this. A change is made, and `changed` called, under `mutex`.
  Reconfigure(const ros::NodeHandle& nh, const core::Params& params, std::mutex& mutex,
              std::function<void()> changed);

 private:
  bool onSet(dynamic_reconfigure::Reconfigure::Request& request,
             dynamic_reconfigure::Reconfigure::Response& response);
  /// Faults of the request; where there are none, it is in force.
  std::vector<std::string> apply(const dynamic_reconfigure::Config& wanted);

  ros::NodeHandle nh_;
  const core::Params& params_;
  std::mutex& mutex_;
  std::function<void()> changed_;
  ros::Publisher description_, updates_;
  ros::ServiceServer service_;
};

}  // namespace field_fusion
