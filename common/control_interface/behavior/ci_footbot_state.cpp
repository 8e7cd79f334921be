#include "common/control_interface/behavior/ci_footbot_state.h"

#include <algorithm>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr std::array kPieColours{CCI_Colour::RED,  CCI_Colour::GREEN,   CCI_Colour::BLUE, CCI_Colour::YELLOW,
                                 CCI_Colour::CYAN, CCI_Colour::MAGENTA, CCI_Colour::WHITE};

}  // namespace

void CCI_FootBotState::Init()
{
  InitCommon();
  devices_.proximity = FindSensor<CCI_FootBotProximitySensor>("footbot_proximity");
  devices_.light = FindSensor<CCI_FootBotLightSensor>("footbot_light");
  devices_.ground = FindSensor<CCI_FootBotGroundSensor>("footbot_ground");
  devices_.gripper_sensor = FindSensor<CCI_FootBotGripperSensor>("footbot_gripper");
  devices_.turret_encoder = FindSensor<CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder");
  devices_.turret_torque = FindSensor<CCI_FootBotTurretTorqueSensor>("footbot_turret_torque");
  devices_.encoders = FindSensor<CCI_FootBotEncodersSensor>("footbot_encoders");
  devices_.pie_camera = FindSensor<CCI_PieCameraSensor>("pie_camera");
  devices_.accelerometer = FindSensor<CCI_FootBotAccelerometerSensor>("footbot_accelerometer");
  devices_.wheels = FindActuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  devices_.gripper = FindActuator<CCI_FootBotGripperActuator>("footbot_gripper");
  devices_.turret = FindActuator<CCI_FootBotTurretActuator>("footbot_turret");
  devices_.beacon = FindActuator<CCI_FootBotBeaconActuator>("footbot_beacon");
  devices_.direction = FindActuator<CCI_FootBotPreferentialDirectionActuator>("footbot_preferential_direction");
}

void CCI_FootBotState::ReadSensors()
{
  ReadCommonSensors();
  const auto copy = [](const auto& readings, auto& to) { std::copy(readings.begin(), readings.end(), to.begin()); };
  if (devices_.proximity != nullptr) copy(devices_.proximity->GetAllSensorReadings(), proximity_);
  if (devices_.light != nullptr) copy(devices_.light->GetAllSensorReadings(), light_);
  if (devices_.ground != nullptr)
  {
    copy(devices_.ground->GetAllSensorReadings(), ground_);
    floor_colour_ = devices_.ground->GetFloorColour();
  }
  if (devices_.gripper_sensor != nullptr)
  {
    gripping_ = devices_.gripper_sensor->IsGripping();
    aperture_ = devices_.gripper_sensor->GetAperture();
    held_id_ = devices_.gripper_sensor->GetHeldId();
  }
  if (devices_.turret_encoder != nullptr) turret_angle_ = devices_.turret_encoder->GetTurretAngle();
  if (devices_.turret_torque != nullptr) copy(devices_.turret_torque->GetAllSensorReadings(), turret_torque_);
  if (devices_.encoders != nullptr) copy(devices_.encoders->GetAllSensorReadings(), wheel_velocities_);
  if (devices_.accelerometer != nullptr) copy(devices_.accelerometer->GetAllSensorReadings(), acceleration_);
  if (devices_.pie_camera != nullptr)
  {
    pie_.clear();
    for (const std::uint32_t colour : kPieColours)
    {
      const auto slices = devices_.pie_camera->GetAllSlices(colour);
      pie_.insert(pie_.end(), slices.begin(), slices.end());
    }
  }
}

void CCI_FootBotState::WriteActuators()
{
  WriteCommonActuators();
  wheels_.Flush([this](const auto& v) { devices_.wheels->SetFootBotWheelsAngularVelocity(v[0], v[1]); });
  gripper_.Flush([this](double closed) { devices_.gripper->SetGripper(closed); });
  turret_.Flush([this](double velocity) { devices_.turret->SetTurretAngularVelocity(velocity); });
  beacon_.Flush([this](std::uint32_t colour) { devices_.beacon->SetColour(colour); });
  direction_.Flush(
      [this](const Direction& direction)
      {
        direction.shown ? devices_.direction->SetDirection(direction.angle, direction.colour)
                        : devices_.direction->HideDirection();
      });
}

void CCI_FootBotState::GetAllProximitySensorReadings(double* readings) const
{
  RequireSensor(devices_.proximity, "footbot_proximity");
  std::copy(proximity_.begin(), proximity_.end(), readings);
}

double CCI_FootBotState::GetProximitySensorReading(unsigned sensor) const
{
  RequireSensor(devices_.proximity, "footbot_proximity");
  return proximity_.at(sensor);
}

void CCI_FootBotState::GetAllLightSensorReadings(double* readings) const
{
  RequireSensor(devices_.light, "footbot_light");
  std::copy(light_.begin(), light_.end(), readings);
}

void CCI_FootBotState::GetAllGroundSensorReadings(double* readings) const
{
  RequireSensor(devices_.ground, "footbot_ground");
  std::copy(ground_.begin(), ground_.end(), readings);
}

std::uint32_t CCI_FootBotState::GetFloorColour() const
{
  return ReadingOf(devices_.ground, "footbot_ground", floor_colour_);
}

unsigned CCI_FootBotState::GetNumPieCameraSectors() const
{
  RequireSensor(devices_.pie_camera, "pie_camera");
  return devices_.pie_camera->GetNumSectors();
}

const CCI_PieCameraSensor::Slice& CCI_FootBotState::GetPieCameraSlice(std::uint32_t colour, unsigned sector) const
{
  const unsigned sectors = GetNumPieCameraSectors();
  const auto place = std::find(kPieColours.begin(), kPieColours.end(), colour);
  if (place == kPieColours.end())
    throw std::invalid_argument("the pie camera knows the colours of CCI_Colour other than black");
  if (sector >= sectors)
    throw std::out_of_range("the pie camera has " + std::to_string(sectors) + " sectors, there is no sector " +
                            std::to_string(sector));
  return pie_.at(static_cast<std::size_t>(place - kPieColours.begin()) * sectors + sector);
}

const std::array<double, 3>& CCI_FootBotState::GetAcceleration() const
{
  return ReadingOf(devices_.accelerometer, "footbot_accelerometer", acceleration_);
}

bool CCI_FootBotState::IsGripping() const { return ReadingOf(devices_.gripper_sensor, "footbot_gripper", gripping_); }

double CCI_FootBotState::GetGripperAperture() const
{
  return ReadingOf(devices_.gripper_sensor, "footbot_gripper", aperture_);
}

const std::string& CCI_FootBotState::GetHeldId() const
{
  return ReadingOf(devices_.gripper_sensor, "footbot_gripper", held_id_);
}

double CCI_FootBotState::GetTurretAngle() const
{
  return ReadingOf(devices_.turret_encoder, "footbot_turret_encoder", turret_angle_);
}

const std::array<double, 3>& CCI_FootBotState::GetTurretTorque() const
{
  return ReadingOf(devices_.turret_torque, "footbot_turret_torque", turret_torque_);
}

const std::array<double, 2>& CCI_FootBotState::GetWheelVelocities() const
{
  return ReadingOf(devices_.encoders, "footbot_encoders", wheel_velocities_);
}

void CCI_FootBotState::SetFootBotWheelsAngularVelocity(double left, double right)
{
  Command(devices_.wheels, "footbot_wheels", wheels_, {left, right});
}

void CCI_FootBotState::SetFootBotWheelsLinearVelocity(double left, double right)
{
  SetFootBotWheelsAngularVelocity(left / CCI_FootBotWheelsActuator::WHEEL_RADIUS_M,
                                  right / CCI_FootBotWheelsActuator::WHEEL_RADIUS_M);
}

void CCI_FootBotState::GetFootBotWheelsAngularVelocity(double& left, double& right) const
{
  left = wheels_.Get()[0];
  right = wheels_.Get()[1];
}

void CCI_FootBotState::SetGripper(double closed) { Command(devices_.gripper, "footbot_gripper", gripper_, closed); }

void CCI_FootBotState::SetTurretAngularVelocity(double velocity)
{
  Command(devices_.turret, "footbot_turret", turret_, velocity);
}

void CCI_FootBotState::SetBeaconColour(std::uint32_t colour)
{
  Command(devices_.beacon, "footbot_beacon", beacon_, colour);
}

void CCI_FootBotState::ShowDirection(double angle, std::uint32_t colour)
{
  Command(devices_.direction, "footbot_preferential_direction", direction_, {true, angle, colour});
}

void CCI_FootBotState::HideDirection()
{
  Command(devices_.direction, "footbot_preferential_direction", direction_, {});
}

}  // namespace swarmanoid
