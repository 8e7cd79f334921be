// The magnet of an eyebot, by which it hangs on the ceiling.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotAttachmentActuator : public CCI_ActuatorOf<CCI_EyeBotAttachmentActuator>
{
public:
  // Attaches as soon as the top of the robot reaches the ceiling, and stays so until Detach.
  virtual void Attach() = 0;
  // Releases the ceiling.
  virtual void Detach() = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"attached", "yes/no", 0, 1}}, [](CCI_EyeBotAttachmentActuator& it, std::span<const double> values)
                { values[0] > 0.5 ? it.Attach() : it.Detach(); });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotAttachmentActuator;
