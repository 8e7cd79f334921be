// The table `robot` of a script has one sub-table for each device, with the names, units and lists (from 1) of ARGoS3.
// Functions are added once, with a pointer to the device; readings are written again before every control step, into
// the same tables, so that a script may keep a reference to them. The tag of a device decides which functions and
// readings it has, and the cast by reference throws if a robot's device is another one.
#include "argos3/plugin/lua_devices.h"

#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_light_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_light_sensor.h>
#include <argos3/plugins/robots/eye-bot/control_interface/ci_eyebot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_base_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_light_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_encoder_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_perspective_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_light_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ground_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_lidar_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_light_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_proximity_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ultrasound_sensor.h>

#include <cmath>

#include "argos3/plugin/lua_device_parts.h"
#include "argos3/plugin/lua_vectors.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

argos::CColor ColourAt(lua_State* lua, int index)
{
  argos::CColor colour;
  if (lua_gettop(lua) == index)
  {
    colour.Set(luaL_checkstring(lua, index));
    return colour;
  }
  CheckCount(lua, index + 2);
  const auto channel = [&](int at)
  {
    const double value = luaL_checknumber(lua, at);
    if (!(value >= 0 && value <= 255)) luaL_argerror(lua, at, "a colour is 0 to 255");
    return static_cast<UInt8>(value);
  };
  const UInt8 red = channel(index);
  const UInt8 green = channel(index + 1);
  colour.Set(red, green, channel(index + 2));
  return colour;
}

UInt8 ByteAt(lua_State* lua, int index)
{
  const double value = luaL_checknumber(lua, index);
  return std::abs(value) < 0x1p62 ? static_cast<UInt8>(static_cast<std::int64_t>(value)) : 0;
}

namespace
{

// The next functions are those of robot.wheels, in cm/s.

int SetVelocity(lua_State* lua)
{
  CheckCount(lua, 2);
  Subject<argos::CCI_DifferentialSteeringActuator>(lua).SetLinearVelocity(luaL_checknumber(lua, 1),
                                                                          luaL_checknumber(lua, 2));
  return 0;
}

void AddWheels(lua_State* lua, argos::CCI_DifferentialSteeringActuator& wheels)
{
  Enter(lua, "wheels");
  SetFunction<SetVelocity>(lua, "set_velocity", &wheels);
  Leave(lua);
}

void ReadWheels(lua_State* lua, argos::CCI_DifferentialSteeringSensor& encoders)
{
  const auto& reading = encoders.GetReading();
  Enter(lua, "wheels");
  Set(lua, "velocity_left", reading.VelocityLeftWheel);
  Set(lua, "velocity_right", reading.VelocityRightWheel);
  Set(lua, "distance_left", reading.CoveredDistanceLeftWheel);
  Set(lua, "distance_right", reading.CoveredDistanceRightWheel);
  Set(lua, "axis_length", reading.WheelAxisLength);
  Leave(lua);
}

// The next functions are those of robot.leds, with colours by name, or by red, green and blue of 0 to 255.

int SetAllColors(lua_State* lua)
{
  Subject<argos::CCI_LEDsActuator>(lua).SetAllColors(ColourAt(lua, 1));
  return 0;
}

int SetSingleColor(lua_State* lua)
{
  auto& leds = Subject<argos::CCI_LEDsActuator>(lua);
  const lua_Integer led = luaL_checkinteger(lua, 1);
  const auto count = static_cast<lua_Integer>(leds.GetNumLEDs());
  if (led < 1 || led > count) return luaL_error(lua, "there is no LED %I; they are 1 to %I", led, count);
  leds.SetSingleColor(static_cast<UInt32>(led - 1), ColourAt(lua, 2));
  return 0;
}

void AddLeds(lua_State* lua, argos::CCI_LEDsActuator& leds)
{
  Enter(lua, "leds");
  SetFunction<SetAllColors>(lua, "set_all_colors", &leds);
  SetFunction<SetSingleColor>(lua, "set_single_color", &leds);
  Leave(lua);
}

// The next functions are those of robot.range_and_bearing, with bytes, cm and rad.

int SetData(lua_State* lua)
{
  auto& sender = Subject<argos::CCI_RangeAndBearingActuator>(lua);
  const auto size = static_cast<lua_Integer>(sender.GetSize());
  if (lua_gettop(lua) == 1)
  {
    luaL_checktype(lua, 1, LUA_TTABLE);
    if (static_cast<lua_Integer>(lua_rawlen(lua, 1)) != size)
      return luaL_error(lua, "%I bytes are given, and a message has %I", static_cast<lua_Integer>(lua_rawlen(lua, 1)),
                        size);
    for (lua_Integer i = 1; i <= size; ++i)
    {
      lua_rawgeti(lua, 1, i);
      sender.SetData(static_cast<size_t>(i - 1), ByteAt(lua, -1));
      lua_pop(lua, 1);
    }
    return 0;
  }
  CheckCount(lua, 2);
  const lua_Integer index = luaL_checkinteger(lua, 1);
  if (index < 1 || index > size) return luaL_error(lua, "there is no byte %I; they are 1 to %I", index, size);
  sender.SetData(static_cast<size_t>(index - 1), ByteAt(lua, 2));
  return 0;
}

int ClearData(lua_State* lua)
{
  Subject<argos::CCI_RangeAndBearingActuator>(lua).ClearData();
  return 0;
}

void AddSender(lua_State* lua, argos::CCI_RangeAndBearingActuator& sender)
{
  Enter(lua, "range_and_bearing");
  SetFunction<SetData>(lua, "set_data", &sender);
  SetFunction<ClearData>(lua, "clear_data", &sender);
  Leave(lua);
}

void ReadPackets(lua_State* lua, argos::CCI_RangeAndBearingSensor& receiver)
{
  Enter(lua, "range_and_bearing");
  lua_Integer count = 0;
  for (const auto& packet : receiver.GetReadings())
  {
    EnterNew(lua, ++count, 4);
    Set(lua, "range", packet.Range);
    Set(lua, "horizontal_bearing", packet.HorizontalBearing.GetValue());
    Set(lua, "vertical_bearing", packet.VerticalBearing.GetValue());
    EnterNew(lua, "data", static_cast<int>(packet.Data.Size()), 0);
    for (size_t i = 0; i < packet.Data.Size(); ++i)
    {
      lua_pushinteger(lua, packet.Data[i]);
      lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
    }
    Leave(lua);
    Leave(lua);
  }
  Shorten(lua, count);
  Leave(lua);
}

// The next functions are those of robot.colored_blob_omnidirectional_camera, in cm and rad.

int EnableCamera(lua_State* lua)
{
  Subject<argos::CCI_Sensor>(lua).Enable();
  return 0;
}

int DisableCamera(lua_State* lua)
{
  Subject<argos::CCI_Sensor>(lua).Disable();
  return 0;
}

constexpr const char* kCamera = "colored_blob_omnidirectional_camera";
constexpr const char* kPerspectiveCamera = "colored_blob_perspective_camera";

void AddCamera(lua_State* lua, const char* name, argos::CCI_Sensor& camera)
{
  Enter(lua, name);
  SetFunction<EnableCamera>(lua, "enable", &camera);
  SetFunction<DisableCamera>(lua, "disable", &camera);
  Leave(lua);
}

void SetColour(lua_State* lua, const argos::CColor& colour)
{
  EnterNew(lua, "color", 0, 3);
  Set(lua, "red", colour.GetRed());
  Set(lua, "green", colour.GetGreen());
  Set(lua, "blue", colour.GetBlue());
  Leave(lua);
}

// Writes the list of blobs of a camera. Each has two numbers, which set(blob) writes, and its colour.
template <class Camera, class SetPlace>
void ReadBlobsOf(lua_State* lua, const char* table, const Camera& camera, const SetPlace& set)
{
  Enter(lua, table);
  lua_Integer count = 0;
  for (const auto* blob : camera.GetReadings().BlobList)
  {
    EnterNew(lua, ++count, 3);
    set(*blob);
    SetColour(lua, blob->Color);
    Leave(lua);
  }
  Shorten(lua, count);
  Leave(lua);
}

template <class Camera>
void ReadBlobs(lua_State* lua, const Camera& camera)
{
  ReadBlobsOf(lua, kCamera, camera,
              [lua](const auto& blob)
              {
                Set(lua, "distance", blob.Distance);
                Set(lua, "angle", blob.Angle.GetValue());
              });
}

// Writes robot.colored_blob_perspective_camera, in pixels.
void ReadImage(lua_State* lua, argos::CCI_ColoredBlobPerspectiveCameraSensor& camera)
{
  ReadBlobsOf(lua, kPerspectiveCamera, camera,
              [lua](const auto& blob)
              {
                Set(lua, "x", blob.X);
                Set(lua, "y", blob.Y);
              });
}

// Sensors with several readings: value, and position or angle of each.

template <class Sensor, class SetPlace>
void ReadEach(lua_State* lua, Sensor& sensor, const char* name, SetPlace set_place)
{
  Enter(lua, name);
  const auto& readings = sensor.GetReadings();
  // Places and angles do not change, so they are written once, as in ARGoS3.
  const bool is_new = lua_rawlen(lua, -1) < readings.size();
  lua_pushliteral(lua, "value");
  const int key = lua_gettop(lua);
  lua_Integer number = 0;
  for (const auto& reading : readings)
  {
    lua_pushvalue(lua, key - 1);
    Enter(lua, ++number);
    if (is_new) set_place(reading);
    lua_pushvalue(lua, key);
    lua_pushnumber(lua, reading.Value);
    lua_rawset(lua, -3);
    lua_settop(lua, key);
  }
  Leave(lua);
  Leave(lua);
}

// Angles are in rad.
template <class Sensor>
void ReadRing(lua_State* lua, Sensor& sensor, const char* name)
{
  ReadEach(lua, sensor, name, [lua](const auto& reading) { Set(lua, "angle", reading.Angle.GetValue()); });
}

// Offsets are in cm.
template <class Sensor>
void ReadGround(lua_State* lua, Sensor& sensor, const char* name)
{
  ReadEach(lua, sensor, name,
           [lua](const auto& reading)
           {
             Enter(lua, "offset");
             Set(lua, "x", reading.Offset.GetX());
             Set(lua, "y", reading.Offset.GetY());
             Leave(lua);
           });
}

// Writes a list of numbers.
void ReadNumbers(lua_State* lua, const std::vector<Real>& readings, const char* name)
{
  Enter(lua, name);
  for (std::size_t i = 0; i < readings.size(); ++i)
  {
    lua_pushnumber(lua, readings[i]);
    lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
  }
  Leave(lua);
}

// ARGoS3 gives scripts no lidar; here it is a list of distances in cm.
void ReadLidar(lua_State* lua, argos::CCI_KheperaIVLIDARSensor& sensor)
{
  std::vector<Real> readings(sensor.GetNumReadings());
  for (UInt32 i = 0; i < readings.size(); ++i) readings[i] = static_cast<Real>(sensor.GetReading(i));
  ReadNumbers(lua, readings, "lidar");
}

// The next functions are those of robot.positioning, in m; the quaternion is also given as an angle about an axis.

void ReadPosition(lua_State* lua, argos::CCI_PositioningSensor& sensor)
{
  const auto& reading = sensor.GetReading();
  Enter(lua, "positioning");
  SetVector(lua, "position", reading.Position);
  SetQuaternion(lua, "orientation", reading.Orientation);
  Leave(lua);
}

void ReadBattery(lua_State* lua, argos::CCI_BatterySensor& sensor)
{
  Enter(lua, "battery");
  Set(lua, "available_charge", sensor.GetReading().AvailableCharge);
  Set(lua, "time_left", sensor.GetReading().TimeLeft);
  Leave(lua);
}

template <class Device, class Base>
Device& As(Base& device)
{
  return dynamic_cast<Device&>(device);
}

[[noreturn]] void Unknown(const char* what, const std::string& tag)
{
  THROW_ARGOSEXCEPTION("the " << what << " '" << tag << "' has no functions in Lua here");
}

}  // namespace

void AddFunctions(lua_State* lua, const std::string& tag, argos::CCI_Actuator& actuator)
{
  if (tag == "differential_steering") return AddWheels(lua, As<argos::CCI_DifferentialSteeringActuator>(actuator));
  if (tag == "leds") return AddLeds(lua, As<argos::CCI_LEDsActuator>(actuator));
  if (tag == "range_and_bearing") return AddSender(lua, As<argos::CCI_RangeAndBearingActuator>(actuator));
  if (tag == "footbot_turret") return AddTurret(lua, As<argos::CCI_FootBotTurretActuator>(actuator));
  if (tag == "footbot_distance_scanner")
    return AddScanner(lua, As<argos::CCI_FootBotDistanceScannerActuator>(actuator));
  if (tag == "footbot_gripper") return AddGripper(lua, As<argos::CCI_FootBotGripperActuator>(actuator));
  if (tag == "quadrotor_position") return AddPosition(lua, As<argos::CCI_QuadRotorPositionActuator>(actuator));
  if (tag == "quadrotor_speed") return AddSpeed(lua, As<argos::CCI_QuadRotorSpeedActuator>(actuator));
  if (!AddEPuckFunctions(lua, tag, actuator) && !AddPiPuckFunctions(lua, tag, actuator)) Unknown("actuator", tag);
}

void AddFunctions(lua_State* lua, const std::string& tag, argos::CCI_Sensor& sensor)
{
  if (tag == kCamera || tag == kPerspectiveCamera) AddCamera(lua, tag.c_str(), sensor);
  if (tag == "epuck_omnidirectional_camera") AddCamera(lua, kCamera, sensor);
}

void AddReadings(lua_State* lua, const std::string& tag, argos::CCI_Sensor& sensor)
{
  if (tag == "differential_steering") return ReadWheels(lua, As<argos::CCI_DifferentialSteeringSensor>(sensor));
  if (tag == "footbot_proximity") return ReadRing(lua, As<argos::CCI_FootBotProximitySensor>(sensor), "proximity");
  if (tag == "epuck_proximity") return ReadRing(lua, As<argos::CCI_EPuckProximitySensor>(sensor), "proximity");
  if (tag == "eyebot_proximity") return ReadRing(lua, As<argos::CCI_EyeBotProximitySensor>(sensor), "proximity");
  if (tag == "proximity") return ReadNumbers(lua, As<argos::CCI_ProximitySensor>(sensor).GetReadings(), "proximity");
  if (tag == "light") return ReadNumbers(lua, As<argos::CCI_LightSensor>(sensor).GetReadings(), "light");
  if (tag == "ground") return ReadNumbers(lua, As<argos::CCI_GroundSensor>(sensor).GetReadings(), "ground");
  if (tag == "footbot_light") return ReadRing(lua, As<argos::CCI_FootBotLightSensor>(sensor), "light");
  if (tag == "eyebot_light") return ReadRing(lua, As<argos::CCI_EyeBotLightSensor>(sensor), "light");
  if (tag == "epuck_light") return ReadRing(lua, As<argos::CCI_EPuckLightSensor>(sensor), "light");
  if (tag == "epuck_ground") return ReadEPuckGround(lua, As<argos::CCI_EPuckGroundSensor>(sensor));
  if (tag == "epuck_range_and_bearing") return ReadEPuckPackets(lua, As<argos::CCI_EPuckRangeAndBearingSensor>(sensor));
  if (tag == "epuck_omnidirectional_camera")
    return ReadBlobs(lua, As<argos::CCI_EPuckOmnidirectionalCameraSensor>(sensor));
  if (tag == "kheperaiv_proximity") return ReadRing(lua, As<argos::CCI_KheperaIVProximitySensor>(sensor), "proximity");
  if (tag == "kheperaiv_ultrasound")
    return ReadRing(lua, As<argos::CCI_KheperaIVUltrasoundSensor>(sensor), "ultrasound");
  if (tag == "kheperaiv_light") return ReadRing(lua, As<argos::CCI_KheperaIVLightSensor>(sensor), "light");
  if (tag == "kheperaiv_ground") return ReadGround(lua, As<argos::CCI_KheperaIVGroundSensor>(sensor), "ground");
  if (tag == "kheperaiv_lidar") return ReadLidar(lua, As<argos::CCI_KheperaIVLIDARSensor>(sensor));
  if (tag == "footbot_motor_ground")
    return ReadGround(lua, As<argos::CCI_FootBotMotorGroundSensor>(sensor), "motor_ground");
  if (tag == "footbot_base_ground")
    return ReadGround(lua, As<argos::CCI_FootBotBaseGroundSensor>(sensor), "base_ground");
  if (tag == "range_and_bearing") return ReadPackets(lua, As<argos::CCI_RangeAndBearingSensor>(sensor));
  if (tag == kPerspectiveCamera) return ReadImage(lua, As<argos::CCI_ColoredBlobPerspectiveCameraSensor>(sensor));
  if (tag == kCamera) return ReadBlobs(lua, As<argos::CCI_ColoredBlobOmnidirectionalCameraSensor>(sensor));
  if (tag == "positioning") return ReadPosition(lua, As<argos::CCI_PositioningSensor>(sensor));
  if (tag == "footbot_distance_scanner") return ReadScanner(lua, As<argos::CCI_FootBotDistanceScannerSensor>(sensor));
  if (tag == "battery") return ReadBattery(lua, As<argos::CCI_BatterySensor>(sensor));
  if (tag == "footbot_turret_encoder")
  {
    Enter(lua, "turret");
    Set(lua, "rotation", As<argos::CCI_FootBotTurretEncoderSensor>(sensor).GetRotation().GetValue());
    return Leave(lua);
  }
  if (!ReadPiPuckSensor(lua, tag, sensor)) Unknown("sensor", tag);
}

}  // namespace swarmanoid::argos3
