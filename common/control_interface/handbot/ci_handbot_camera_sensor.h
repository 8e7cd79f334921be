// The camera in the head of a handbot looks ahead and extracts blobs.
#pragma once

#include "common/control_interface/ci_colour_blob_sensor.h"

namespace swarmanoid
{

class CCI_HandBotCameraSensor : public CCI_ColourBlobSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotCameraSensor;
