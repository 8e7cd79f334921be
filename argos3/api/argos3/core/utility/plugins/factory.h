// What the macros that register plug-ins share. Libraries written for ARGoS3 can register controllers, loop functions,
// Qt user functions, sensors and actuators.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>
#include <argos3/core/utility/plugins/refused.h>

#include <string>

namespace argos
{

class CCI_Controller;
class CLoopFunctions;

// The macros use it while the library is loaded. If a label occurs twice, the first one stays.
struct SControllerRegistration
{
  SControllerRegistration(const char* label, CCI_Controller* (*create)());
};
struct SLoopFunctionsRegistration
{
  SLoopFunctionsRegistration(const char* label, CLoopFunctions* (*create)());
};

}  // namespace argos
