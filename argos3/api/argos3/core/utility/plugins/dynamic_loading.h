// CDynamicLoading, for programs that load libraries before an experiment. Here an experiment loads those that it names.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>

namespace argos
{

class CDynamicLoading
{
public:
  static void LoadAllLibraries() {}
  static void UnloadAllLibraries() {}
};

}  // namespace argos
