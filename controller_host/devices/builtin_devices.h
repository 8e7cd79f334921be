// The code that each file of this folder binds to the descriptions of common/plugin_descriptions.
#pragma once

namespace swarmanoid
{

void RegisterFootbotWheels();
void RegisterFootbotProximity();
void RegisterFootbotGripper();
void RegisterFootbotTurret();
void RegisterFootbotEncoders();
void RegisterFootbotAccelerometer();
void RegisterLight();
void RegisterLightRing();
void RegisterGround();
void RegisterProximity();
void RegisterWheels();
void RegisterLeds();
void RegisterPreferentialDirection();
void RegisterColourCameras();
void RegisterPieCamera();
void RegisterMotionSensors();
void RegisterMicrophones();
void RegisterDistanceScanners();
void RegisterDepthCameras();
void RegisterContact();
void RegisterTagReader();
void RegisterFunctionsChannel();
void RegisterRadioSender();
void RegisterRadioReceiver();
void RegisterRangeAndBearingSender();
void RegisterRangeAndBearingReceiver();
void RegisterEyebotPropellers();
void RegisterEyebotAttachment();
void RegisterEyebotAltitude();
void RegisterEyebotLaser();
void RegisterHandbotJoints();
void RegisterHandbotProximity();
void RegisterHandbotRope();

}  // namespace swarmanoid
