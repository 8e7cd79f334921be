// What each file of this folder adds to the registries of devices.
#pragma once

namespace swarmanoid
{

void RegisterFootbotWheels();
void RegisterFootbotProximity();
void RegisterFootbotGripper();
void RegisterFootbotTurret();
void RegisterFootbotEncoders();
void RegisterFootbotAccelerometer();
void RegisterFootbotLight();
void RegisterGround();
void RegisterProximity();
void RegisterWheels();
void RegisterLeds();
void RegisterPreferentialDirection();
void RegisterColourCameras();
void RegisterPieCamera();
void RegisterRangeAndBearingSender();
void RegisterRangeAndBearingReceiver();
void RegisterEyebotPropellers();
void RegisterEyebotAttachment();
void RegisterEyebotAltitude();
void RegisterEyebotLaser();
void RegisterHandbotJoints();
void RegisterHandbotRope();

}  // namespace swarmanoid
