// Extension modules such as NumPy find the functions of Python among the symbols that all libraries of a process see.
// So Python is loaded with RTLD_GLOBAL, unless the process is a program of Python and has it.
#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

#include "common/math/reproducible_math.h"
#include "common/plugins/script_parameters.h"
#include "controller_host/scripts/declaration/script_declaration.h"
#include "controller_host/scripts/python/python_scripts.h"

namespace swarmanoid
{
namespace
{

[[noreturn]] void FailToLoad(const std::string& what)
{
  const char* reason = dlerror();
  throw std::runtime_error("Python cannot be loaded (" + what +
                           "): " + (reason == nullptr ? "unknown reason" : reason));
}

const PythonScripts& Load()
{
  const FloatingPointGuard guard;
  if (dlsym(RTLD_DEFAULT, "Py_IsInitialized") == nullptr &&
      dlopen(SWARMANOID_LIBPYTHON, RTLD_NOW | RTLD_GLOBAL) == nullptr)
    FailToLoad(SWARMANOID_LIBPYTHON);
  Dl_info own{};
  dladdr(reinterpret_cast<const void*>(&Load), &own);
  const std::filesystem::path folder = std::filesystem::path(own.dli_fname).parent_path();
  void* library = OpenLibrary((folder / "scripts" / "libpython_scripts.so").string());
  if (library == nullptr) FailToLoad("libpython_scripts.so");
  void* function = dlsym(library, kGetPythonScripts);
  if (function == nullptr) FailToLoad(kGetPythonScripts);
  return reinterpret_cast<GetPythonScripts>(function)();
}

const PythonScripts& Scripts()
{
  static const PythonScripts& scripts = Load();
  return scripts;
}

std::vector<ParameterSpec> ParametersOfScript(const TConfigurationTree& parameters, const std::string& folder)
{
  return ReadScriptDeclaration(parameters, folder,
                               [](const std::string& file, const std::string& path)
                               { return Scripts().read_declaration(file, path); });
}

const ControllerRegistration registration(
    []() -> std::unique_ptr<CCI_Controller> { return Scripts().make_controller(); }, "PythonScriptController",
    PluginDescription{
        .label = "python_controller",
        .brief = "runs a script in Python, which declares more parameters",
        .parameters = {{.name = kScriptParameter, .type = ParameterType::kPath, .description = "The script."}}});

const bool declares = []
{
  ScriptParameters::Instance().Add("python_controller", ParametersOfScript);
  return true;
}();

}  // namespace
}  // namespace swarmanoid
