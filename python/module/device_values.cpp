#include "python/module/device_values.h"

#include <algorithm>

#include "common/control_interface/ci_battery_sensor.h"
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_contact_sensor.h"
#include "common/control_interface/ci_depth_camera_sensor.h"
#include "common/control_interface/ci_distance_scanner_sensor.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_gyroscope_sensor.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_light_sensor.h"
#include "common/control_interface/ci_microphone_sensor.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_motor_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_beacon_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_joints_sensor.h"
#include "common/control_interface/handbot/ci_handbot_proximity_sensor.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid::python
{
namespace
{

// The names by which people know the readings, if there is one for each column.
std::vector<std::string> NamesOf(const CCI_Sensor& sensor, std::size_t columns)
{
  std::vector<CCI_Reading> readings;
  sensor.Describe(readings);
  std::vector<std::string> names;
  for (const CCI_Reading& reading : readings)
    names.push_back(reading.unit.empty() ? reading.name : reading.name + " [" + reading.unit + "]");
  if (names.size() == columns) return names;
  names.clear();
  for (std::size_t i = 0; i < columns; ++i) names.push_back(std::to_string(i));
  return names;
}

template <class Span>
SensorColumns Of(const CCI_Sensor& sensor, std::size_t columns, Span span)
{
  return {NamesOf(sensor, columns), [span](double* to)
          {
            for (const double value : span()) *to++ = value;
          }};
}

template <class Interface>
bool AddReadings(CCI_Sensor& sensor, SensorColumns& columns)
{
  const auto* const typed = dynamic_cast<const Interface*>(&sensor);
  if (typed == nullptr) return false;
  columns = Of(sensor, typed->GetAllSensorReadings().size(), [typed] { return typed->GetAllSensorReadings(); });
  return true;
}

// Numbers are finite: whoever writes them has looked.
std::uint32_t Colour(double value) { return static_cast<std::uint32_t>(std::clamp(value, 0.0, double{0xffffff})); }

}  // namespace

std::map<std::string, CCI_Sensor*> SensorsOf(const CCI_Robot& robot)
{
  std::map<std::string, CCI_Sensor*> sensors;
  for (const std::string& type : PluginCatalogue::Instance().Labels(PluginKind::kSensor))
    if (robot.HasSensor(type)) sensors[type] = robot.GetSensor(type);
  return sensors;
}

std::map<std::string, CCI_Actuator*> ActuatorsOf(const CCI_Robot& robot)
{
  std::map<std::string, CCI_Actuator*> actuators;
  for (const std::string& type : PluginCatalogue::Instance().Labels(PluginKind::kActuator))
    if (robot.HasActuator(type)) actuators[type] = robot.GetActuator(type);
  return actuators;
}

SensorColumns ColumnsOf(CCI_Sensor& sensor)
{
  SensorColumns columns;
  if (AddReadings<CCI_FootBotProximitySensor>(sensor, columns) || AddReadings<CCI_ProximitySensor>(sensor, columns) ||
      AddReadings<CCI_FootBotLightSensor>(sensor, columns) || AddReadings<CCI_LightSensor>(sensor, columns) ||
      AddReadings<CCI_EyeBotLightSensor>(sensor, columns) || AddReadings<CCI_FootBotGroundSensor>(sensor, columns) ||
      AddReadings<CCI_GroundSensor>(sensor, columns) || AddReadings<CCI_FootBotBaseGroundSensor>(sensor, columns) ||
      AddReadings<CCI_FootBotMotorGroundSensor>(sensor, columns) || AddReadings<CCI_GyroscopeSensor>(sensor, columns) ||
      AddReadings<CCI_FootBotEncodersSensor>(sensor, columns) ||
      AddReadings<CCI_FootBotAccelerometerSensor>(sensor, columns) ||
      AddReadings<CCI_FootBotTurretTorqueSensor>(sensor, columns) ||
      AddReadings<CCI_HandBotJointsSensor>(sensor, columns) || AddReadings<CCI_HandBotProximitySensor>(sensor, columns))
    return columns;
  if (const auto* camera = dynamic_cast<CCI_DepthCameraSensor*>(&sensor))
  {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < camera->GetAllPixels().size(); ++i)
    {
      names.push_back("depth " + std::to_string(i) + " [m]");
      names.push_back("colour " + std::to_string(i));
    }
    return {names, [camera](double* to)
            {
              for (const CCI_DepthCameraSensor::Pixel& pixel : camera->GetAllPixels())
              {
                *to++ = pixel.depth_m;
                *to++ = pixel.colour;
              }
            }};
  }
  if (const auto* contact = dynamic_cast<CCI_ContactSensor*>(&sensor))
    // Whether anything touches; where is told by rows.
    return {{"touched"}, [contact](double* to) { *to = contact->GetAllContacts().empty() ? 0 : 1; }};
  if (const auto* positioning = dynamic_cast<CCI_PositioningSensor*>(&sensor))
    return {{"x [m]", "y [m]", "z [m]", "qx", "qy", "qz", "qw"},
            [positioning](double* to)
            {
              const Vector3 place = positioning->GetPosition();
              const Quaternion turn = positioning->GetOrientation();
              for (const double value : {place.x(), place.y(), place.z(), turn.x(), turn.y(), turn.z(), turn.w()})
                *to++ = value;
            }};
  if (const auto* battery = dynamic_cast<CCI_BatterySensor*>(&sensor))
    return {{"charge", "time left [s]"},
            [battery](double* to)
            {
              to[0] = battery->GetCharge();
              to[1] = battery->GetTimeLeft();
            }};
  if (const auto* turret = dynamic_cast<CCI_FootBotTurretEncoderSensor*>(&sensor))
    return {{"angle [rad]"}, [turret](double* to) { *to = turret->GetTurretAngle(); }};
  if (const auto* gripper = dynamic_cast<CCI_FootBotGripperSensor*>(&sensor))
    return {{"aperture [rad]", "gripping"},
            [gripper](double* to)
            {
              to[0] = gripper->GetAperture();
              to[1] = gripper->IsGripping() ? 1 : 0;
            }};
  if (const auto* altitude = dynamic_cast<CCI_EyeBotAltitudeSensor*>(&sensor))
    return {{"altitude [m]"}, [altitude](double* to) { *to = altitude->GetAltitude(); }};
  if (const auto* microphone = dynamic_cast<CCI_MicrophoneSensor*>(&sensor))
    return {{"loudness"}, [microphone](double* to) { *to = microphone->GetLoudness(); }};
  return {};
}

SensorRows RowsOf(CCI_Sensor& sensor)
{
  if (const auto* camera = dynamic_cast<CCI_ColourBlobSensor*>(&sensor))
    return {{"colour", "distance [m]", "angle [rad]", "elevation [rad]"},
            [camera](std::vector<double>& to)
            {
              for (const CCI_ColourBlob& blob : camera->GetAllBlobs())
                to.insert(to.end(),
                          {static_cast<double>(blob.colour), blob.distance_m, blob.angle_rad, blob.elevation_rad});
            }};
  if (const auto* radio = dynamic_cast<CCI_RangeAndBearingSensor*>(&sensor))
  {
    std::vector<std::string> names{"range [m]", "bearing [rad]", "vertical bearing [rad]"};
    for (unsigned i = 0; i < CCI_RangeAndBearingActuator::NUM_BYTES; ++i) names.push_back("byte " + std::to_string(i));
    return {names, [radio](std::vector<double>& to)
            {
              for (const auto& packet : radio->GetAllPackets())
              {
                to.insert(to.end(), {packet.range_m, packet.bearing_rad, packet.vertical_bearing_rad});
                to.insert(to.end(), packet.message.begin(), packet.message.end());
              }
            }};
  }
  if (const auto* scanner = dynamic_cast<CCI_DistanceScannerSensor*>(&sensor))
    return {{"angle [rad]", "distance [m]", "echo"},
            [scanner](std::vector<double>& to)
            {
              for (const auto& reading : scanner->GetAllReadings())
                to.insert(to.end(), {reading.angle_rad, reading.distance_m, static_cast<double>(reading.echo)});
            }};
  return {};
}

ActuatorColumns ColumnsOf(CCI_Actuator& actuator)
{
  if (auto* wheels = dynamic_cast<CCI_FootBotWheelsActuator*>(&actuator))
    return {{"left [rad/s]", "right [rad/s]"},
            [wheels](const double* from) { wheels->SetFootBotWheelsAngularVelocity(from[0], from[1]); }};
  if (auto* wheels = dynamic_cast<CCI_WheelsActuator*>(&actuator))
    return {{"left [rad/s]", "right [rad/s]"},
            [wheels](const double* from) { wheels->SetAngularVelocity(from[0], from[1]); }};
  if (auto* ring = dynamic_cast<CCI_LedRingActuator*>(&actuator))
  {
    std::vector<std::string> names;
    for (unsigned led = 0; led < ring->GetNumLeds(); ++led) names.push_back("led " + std::to_string(led));
    return {names, [ring](const double* from)
            {
              for (unsigned led = 0; led < ring->GetNumLeds(); ++led) ring->SetColour(led, Colour(from[led]));
            }};
  }
  if (auto* beacon = dynamic_cast<CCI_FootBotBeaconActuator*>(&actuator))
    return {{"colour"}, [beacon](const double* from) { beacon->SetColour(Colour(*from)); }};
  if (auto* beacon = dynamic_cast<CCI_HandBotBeaconActuator*>(&actuator))
    return {{"colour"}, [beacon](const double* from) { beacon->SetColour(Colour(*from)); }};
  if (auto* gripper = dynamic_cast<CCI_FootBotGripperActuator*>(&actuator))
    return {{"closed"}, [gripper](const double* from) { gripper->SetGripper(*from); }};
  if (auto* turret = dynamic_cast<CCI_FootBotTurretActuator*>(&actuator))
    return {{"velocity [rad/s]"}, [turret](const double* from) { turret->SetTurretAngularVelocity(*from); }};
  if (auto* propellers = dynamic_cast<CCI_EyeBotPropellersActuator*>(&actuator))
    return {{"forward [m/s]", "left [m/s]", "up [m/s]", "yaw rate [rad/s]"},
            [propellers](const double* from) { propellers->SetVelocity(from[0], from[1], from[2], from[3]); }};
  if (auto* attachment = dynamic_cast<CCI_EyeBotAttachmentActuator*>(&actuator))
    return {{"attached"},
            [attachment](const double* from) { *from > 0.5 ? attachment->Attach() : attachment->Detach(); }};
  if (auto* laser = dynamic_cast<CCI_EyeBotLaserActuator*>(&actuator))
    return {{"on", "colour", "pan [rad]", "tilt [rad]"},
            [laser](const double* from)
            {
              from[0] > 0.5 ? laser->SwitchOn() : laser->SwitchOff();
              laser->SetColour(Colour(from[1]));
              laser->SetDirection(from[2], from[3]);
            }};
  if (auto* head = dynamic_cast<CCI_HandBotHeadActuator*>(&actuator))
    return {{"velocity [rad/s]"}, [head](const double* from) { head->SetHeadAngularVelocity(*from); }};
  if (auto* arms = dynamic_cast<CCI_HandBotArmsActuator*>(&actuator))
    return {{"left arm [rad/s]", "right arm [rad/s]", "left wrist [rad/s]", "right wrist [rad/s]"},
            [arms](const double* from)
            {
              arms->SetArmVelocities(from[0], from[1]);
              arms->SetWristVelocities(from[2], from[3]);
            }};
  if (auto* hands = dynamic_cast<CCI_HandBotHandsActuator*>(&actuator))
    return {{"left closed", "right closed"},
            [hands](const double* from)
            {
              for (const auto hand : {CCI_HandBotHandsActuator::LEFT, CCI_HandBotHandsActuator::RIGHT})
                from[hand] > 0.5 ? hands->Close(hand) : hands->Open(hand);
            }};
  if (auto* rope = dynamic_cast<CCI_HandBotRopeActuator*>(&actuator))
    return {{"attached", "winch [m/s]"},
            [rope](const double* from)
            {
              from[0] > 0.5 ? rope->Launch() : rope->Release();
              rope->SetWinchVelocity(from[1]);
            }};
  if (auto* radio = dynamic_cast<CCI_RangeAndBearingActuator*>(&actuator))
  {
    std::vector<std::string> names{"sending"};
    for (unsigned i = 0; i < CCI_RangeAndBearingActuator::NUM_BYTES; ++i) names.push_back("byte " + std::to_string(i));
    return {names, [radio](const double* from)
            {
              if (!(from[0] > 0.5)) return radio->StopSending();
              CCI_RangeAndBearingActuator::Message message{};
              for (unsigned i = 0; i < message.size(); ++i)
                message[i] = static_cast<std::uint8_t>(std::clamp(from[1 + i], 0.0, 255.0));
              radio->SetMessage(message);
            }};
  }
  return {};
}

}  // namespace swarmanoid::python
