// CDynamicLoading, for programs that load libraries themselves. An experiment loads the libraries that it names.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>

namespace argos
{

class CDynamicLoading
{
public:
  using TDLHandle = void*;
  // Loads a library by a path, with or without .so, from the working folder or a folder of ARGOS_PLUGIN_PATH. It stays
  // loaded to the end of the process. Throws CARGoSException with the tried paths if none exists.
  static TDLHandle LoadLibrary(const std::string& library);
  static void UnloadLibrary(const std::string& /*library*/) {}
  static void LoadAllLibraries() {}
  static void UnloadAllLibraries() {}
};

}  // namespace argos
