// A Pi-Puck that prints the readings of its sensors in its third step and drives, a foot-bot that looks at it, and loop
// functions that paint the floor and print where robots are.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_ground_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_leds_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_rangefinders_sensor.h>
#include <argos3/plugins/robots/pi-puck/simulator/pipuck_entity.h>

using namespace argos;

class CPiPuck : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    drive_ = GetActuator<CCI_PiPuckDifferentialDriveActuator>("pipuck_differential_drive");
    leds_ = GetActuator<CCI_PiPuckLEDsActuator>("pipuck_leds");
    speeds_ = GetSensor<CCI_PiPuckDifferentialDriveSensor>("pipuck_differential_drive");
    rangefinders_ = GetSensor<CCI_PiPuckRangefindersSensor>("pipuck_rangefinders");
    ground_ = GetSensor<CCI_PiPuckGroundSensor>("pipuck_ground");
    GetNodeAttribute(node, "left", left_);
    GetNodeAttribute(node, "right", right_);
  }
  void ControlStep() override
  {
    drive_->SetLinearVelocity(left_, right_);
    leds_->SetRingLEDs(true);
    leds_->SetRingLEDIndex(3, false);
    leds_->SetFrontLED(true);
    if (++steps_ != 3) return;
    LOG << "ranges";
    rangefinders_->Visit(
        [](const CCI_PiPuckRangefindersSensor::SInterface& sensor)
        {
          CVector3 direction(CVector3::Z);
          direction.Rotate(std::get<CQuaternion>(sensor.Configuration));
          LOG << " " << +sensor.Label << ":" << sensor.Proximity << ":" << std::get<CVector3>(sensor.Configuration)
              << ":" << direction << ":" << std::get<Real>(sensor.Configuration) << ":" << sensor.Illuminance;
        });
    LOG << std::endl << "ground";
    ground_->Visit(
        [](const CCI_PiPuckGroundSensor::SInterface& sensor)
        {
          CVector3 direction(CVector3::Z);
          direction.Rotate(std::get<CQuaternion>(sensor.Configuration));
          LOG << " " << +sensor.Label << ":" << sensor.Reflected << ":" << std::get<CVector3>(sensor.Configuration)
              << ":" << std::get<std::string>(sensor.Configuration) << ":" << direction.GetZ();
        });
    LOG << std::endl << "speeds " << speeds_->GetLeftVelocity() << " " << speeds_->GetRightVelocity() << std::endl;
  }

private:
  CCI_PiPuckDifferentialDriveActuator* drive_ = nullptr;
  CCI_PiPuckLEDsActuator* leds_ = nullptr;
  CCI_PiPuckDifferentialDriveSensor* speeds_ = nullptr;
  CCI_PiPuckRangefindersSensor* rangefinders_ = nullptr;
  CCI_PiPuckGroundSensor* ground_ = nullptr;
  Real left_ = 0, right_ = 0;
  int steps_ = 0;
};

class CPiPuckWatcher : public CCI_Controller
{
public:
  void Init(TConfigurationNode&) override
  {
    camera_ = GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera");
    camera_->Enable();
  }
  void ControlStep() override { LOG << "blobs " << camera_->GetReadings().BlobList.size() << std::endl; }

private:
  CCI_ColoredBlobOmnidirectionalCameraSensor* camera_ = nullptr;
};

class CPiPuckFloor : public CLoopFunctions
{
public:
  void PostStep() override
  {
    for (auto& [id, any] : GetSpace().GetEntitiesByType("pipuck"))
    {
      auto& pipuck = *any_cast<CPiPuckEntity*>(any);
      const SAnchor& body = pipuck.GetEmbodiedEntity().GetOriginAnchor();
      CRadians heading, pitch, roll;
      body.Orientation.ToEulerAngles(heading, pitch, roll);
      const SBoundingBox& box = pipuck.GetEmbodiedEntity().GetBoundingBox();
      LOG << "at " << id << " " << body.Position << " " << ToDegrees(heading).GetValue() << " size "
          << box.MaxCorner - box.MinCorner << " lit";
      for (UInt32 led = 0; led < pipuck.GetLEDEquippedEntity().GetNumLEDs(); ++led)
        LOG << " " << (pipuck.GetLEDEquippedEntity().GetLED(led).GetColor() == CColor::WHITE);
      LOG << std::endl;
    }
  }
  CColor GetFloorColor(const CVector2& place) override { return place.GetY() > 0.005 ? CColor::BLACK : CColor::WHITE; }
};

REGISTER_CONTROLLER(CPiPuck, "pipuck")
REGISTER_CONTROLLER(CPiPuckWatcher, "pipuck_watcher")
REGISTER_LOOP_FUNCTIONS(CPiPuckFloor, "pipuck_floor")
