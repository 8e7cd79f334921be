// CSimulatedSensor and REGISTER_SENSOR: sensors of users, for the robots of the arena. They work in a run of one
// process.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/plugins/factory.h>

#include <type_traits>

namespace argos
{

class CComposableEntity;

class CSimulatedSensor
{
public:
  virtual ~CSimulatedSensor() {}
  // Gets the robot, before Init of the sensor.
  virtual void SetRobot(CComposableEntity& robot) = 0;
  // Reads the arena; called before each control step.
  virtual void Update() = 0;
};

// A sensor, as the simulator and as controllers see it.
struct SMadeSensor
{
  CSimulatedSensor* Simulated;
  CCI_Sensor* Sensor;
};

struct SSensorRegistration
{
  SSensorRegistration(const char* label, SMadeSensor (*make)());
};

}  // namespace argos

// `swarmanoid` finds the library of a sensor by the text that begins with "argos3 sensor".
#define REGISTER_SENSOR(CLASSNAME, LABEL, IMPLEMENTATION, AUTHOR, VERSION, BRIEF, LONG, STATUS)                       \
  static_assert(std::is_base_of<argos::CCI_Sensor, CLASSNAME>::value,                                                 \
                "a sensor also derives from the class that controllers use, which derives from CCI_Sensor");          \
  namespace                                                                                                           \
  {                                                                                                                   \
  const argos::SSensorRegistration argos3_registration_of_##CLASSNAME("argos3 sensor " LABEL " (" IMPLEMENTATION ")", \
                                                                      []() -> argos::SMadeSensor                      \
                                                                      {                                               \
                                                                        CLASSNAME* made = new CLASSNAME;              \
                                                                        return {made, made};                          \
                                                                      });                                             \
  }
