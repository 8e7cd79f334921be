// A camera in the rim of a footbot looks ahead and extracts blobs.
#pragma once

#include "common/control_interface/ci_colour_blob_sensor.h"

namespace swarmanoid
{

class CCI_FootBotPerspectiveCameraSensor : public CCI_ColourBlobSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotPerspectiveCameraSensor;
