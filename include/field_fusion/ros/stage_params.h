#pragma once
#include "field_fusion/core/base/params.h"

namespace field_fusion {

/// The parameters that every stage has beside its own.
struct StageParams {
  double input_timeout = 1.0;
  double hold_limit = 0.2;

  void declare(core::Params& p) {
    p.number("input_timeout", input_timeout, {0.05, 3600.0}, "s", core::When::kLive,
             "An input that is silent for longer is reported in /diagnostics (wall time).");
    p.number("hold_limit", hold_limit, {0.0, 10.0}, "s", core::When::kLive,
             "How long a message may wait for what belongs to it, such as its transform (wall time).");
  }
};

}  // namespace field_fusion
