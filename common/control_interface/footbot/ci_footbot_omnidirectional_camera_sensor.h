// The omnidirectional camera of a footbot (a camera that looks up into a mirror above the robot), as extracted blobs.
#pragma once

#include "common/control_interface/ci_colour_blob_sensor.h"

namespace swarmanoid
{

class CCI_FootBotOmnidirectionalCameraSensor : public CCI_ColourBlobSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotOmnidirectionalCameraSensor;
