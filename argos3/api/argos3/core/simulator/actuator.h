// CSimulatedActuator and REGISTER_ACTUATOR: actuators of users, for the robots of the arena. They work in a run of one
// process.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/plugins/factory.h>

#include <type_traits>

namespace argos
{

class CComposableEntity;

class CSimulatedActuator
{
public:
  virtual ~CSimulatedActuator() {}
  // Gets the robot, before Init of the actuator.
  virtual void SetRobot(CComposableEntity& robot) = 0;
  // Changes the arena, as loop functions do; called after each control step.
  virtual void Update() = 0;
};

// An actuator, as the simulator and as controllers see it.
struct SMadeActuator
{
  CSimulatedActuator* Simulated;
  CCI_Actuator* Actuator;
};

struct SActuatorRegistration
{
  SActuatorRegistration(const char* label, SMadeActuator (*make)());
};

}  // namespace argos

// `swarmanoid` finds the library of an actuator by the text that begins with "argos3 actuator".
#define REGISTER_ACTUATOR(CLASSNAME, LABEL, IMPLEMENTATION, AUTHOR, VERSION, BRIEF, LONG, STATUS)                    \
  static_assert(std::is_base_of<argos::CCI_Actuator, CLASSNAME>::value,                                              \
                "an actuator also derives from the class that controllers use, which derives from CCI_Actuator");    \
  namespace                                                                                                          \
  {                                                                                                                  \
  const argos::SActuatorRegistration argos3_registration_of_##CLASSNAME("argos3 actuator " LABEL " (" IMPLEMENTATION \
                                                                        ")",                                         \
                                                                        []() -> argos::SMadeActuator                 \
                                                                        {                                            \
                                                                          CLASSNAME* made = new CLASSNAME;           \
                                                                          return {made, made};                       \
                                                                        });                                          \
  }
