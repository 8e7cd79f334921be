#include "launcher/supervision/bus_library.h"

#include <stdexcept>

#include "common/plugins/own_library.h"

namespace swarmanoid
{
namespace
{

const BusLibrary& Load()
{
  try
  {
    void* const function = FunctionOfOwnLibrary("launcher_bus", "SwarmanoidBusLibrary");
    return reinterpret_cast<decltype(&SwarmanoidBusLibrary)>(function)();
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error("the library for runs over DDS cannot be loaded (" + std::string(error.what()) +
                             "); install Swarmanoid again");
  }
}

}  // namespace

const BusLibrary& LoadBusLibrary()
{
  static const BusLibrary& library = Load();
  return library;
}

}  // namespace swarmanoid
