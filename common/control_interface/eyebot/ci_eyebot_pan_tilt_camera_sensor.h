// The camera of an eyebot on the unit that turns its laser (CCI_EyeBotLaserActuator::SetDirection), as extracted blobs.
// The distance of a blob is measured along the line of sight, its elevation is negative below the horizontal.
#pragma once

#include "common/control_interface/ci_colour_blob_sensor.h"

namespace swarmanoid
{

class CCI_EyeBotPanTiltCameraSensor : public CCI_ColourBlobSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotPanTiltCameraSensor;
