// The magnet of an eyebot, by which it hangs on the ceiling.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotAttachmentActuator : public CCI_Actuator
{
public:
  // Attaches as soon as the top of the robot reaches the ceiling, and stays so until Detach.
  virtual void Attach() = 0;
  virtual void Detach() = 0;

  std::vector<CCI_Column> Columns() const override { return {{"attached", "yes/no", 0, 1}}; }
  void SetColumns(std::span<const double> values) override { values[0] > 0.5 ? Attach() : Detach(); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotAttachmentActuator;
