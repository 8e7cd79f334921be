// An eyebot has a magnet at its top, by which it hangs on the ceiling.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotAttachmentActuator : public CCI_ActuatorOf<CCI_EyeBotAttachmentActuator>
{
public:
  // Attaches the robot as soon as its top reaches the ceiling. It stays attached until Detach.
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
