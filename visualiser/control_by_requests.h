// ExperimentControl that hands each order to a function. Used by the visualiser program and by the runner of a single
// process.
#pragma once

#include <functional>
#include <utility>

#include "idl/control_request_message.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class ControlByRequests : public ExperimentControl
{
public:
  explicit ControlByRequests(std::function<void(const ControlOrder& order)> send) : send_(std::move(send)) {}
  void Ask(const ControlOrder& order) override { send_(order); }

private:
  std::function<void(const ControlOrder& order)> send_;
};

}  // namespace swarmanoid
