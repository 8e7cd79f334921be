// Controllers whose control steps are made by one call, such as a script that works on arrays over all its robots.
#pragma once

#include <span>

#include "common/control_interface/ci_controller.h"

namespace swarmanoid
{

// The result of a robot must not depend on which others are in the call, since clusters divide robots among hosts.
class CCI_StepGroup
{
public:
  virtual ~CCI_StepGroup() = default;
  // Makes the control steps of some controllers of the group, in the order of their robots.
  virtual void ControlSteps(std::span<CCI_Controller* const> controllers) = 0;
};

// A second base of a controller that belongs to a group. The host calls ControlSteps of the group instead of its
// ControlStep, unless the controller has on_failure or a time budget.
class CCI_InStepGroup
{
public:
  virtual ~CCI_InStepGroup() = default;
  // Returns the group, which lives as long as the controller. Called after Init.
  virtual CCI_StepGroup& StepGroup() = 0;
};

}  // namespace swarmanoid
