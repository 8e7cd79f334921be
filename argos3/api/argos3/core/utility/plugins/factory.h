// REGISTER_SYMBOL: the only kinds of plug-ins that libraries written for ARGoS3 bring here are controllers and loop
// functions.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>

#include <string>

namespace argos
{

class CCI_Controller;
class CLoopFunctions;

// Used by the macros, while the library is loaded. Of two of one label the first one stays.
struct SControllerRegistration
{
  SControllerRegistration(const char* label, CCI_Controller* (*create)());
};
struct SLoopFunctionsRegistration
{
  SLoopFunctionsRegistration(const char* label, CLoopFunctions* (*create)());
};

}  // namespace argos
