// The two libraries of <python_controller>. The plug-in libpython.so is loaded with an experiment and knows nothing of
// Python. It loads Python, and libpython_scripts.so with the code that uses it, when a script is first read.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/control_interface/ci_controller.h"

namespace swarmanoid
{

struct PythonScripts
{
  std::unique_ptr<CCI_Controller> (*make_controller)();
  // Returns the parameters that a script declares. Throws std::runtime_error with file and line of a mistake.
  std::vector<ParameterSpec> (*read_declaration)(const std::string& file, const std::string& path);
};

// libpython_scripts.so has a function of this type and name. It starts Python if the process has none, and throws
// std::runtime_error if it cannot.
using GetPythonScripts = const PythonScripts& (*)();
inline constexpr const char* kGetPythonScripts = "SwarmanoidPythonScripts";

}  // namespace swarmanoid
