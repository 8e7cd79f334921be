// The camera under an eyebot looks straight down and extracts blobs. The distance of a blob is measured along the floor
// from the point below the camera.
#pragma once

#include "common/control_interface/ci_colour_blob_sensor.h"

namespace swarmanoid
{

class CCI_EyeBotCameraSensor : public CCI_ColourBlobSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotCameraSensor;
