// All robots of one entry of <controllers> in a process share a script, which makes their steps by one call. Robots
// join their group in Init. The threads of the simulator do not hold Python's lock; every call here takes it.
//
// No object of Python outlives its controllers. Python itself runs until the process ends.
#include <pybind11/stl.h>

#include <algorithm>
#include <istream>
#include <iterator>
#include <map>
#include <mutex>
#include <ostream>
#include <stdexcept>

#include "common/control_interface/ci_batch_controller.h"
#include "common/math/reproducible_math.h"
#include "controller_host/scripts/declaration/script_declaration.h"
#include "controller_host/scripts/python/python_scripts.h"
#include "controller_host/scripts/python/script_robots.h"
#include "controller_host/scripts/python/script_runtime.h"

namespace py = pybind11;

namespace swarmanoid::python_scripts
{
namespace
{

// Starts Python as in the program python3, but without the user's environment, signal handlers, and files of bytecode.
void StartPython()
{
  PyConfig config;
  PyConfig_InitIsolatedConfig(&config);
  config.use_hash_seed = 1;  // sets have the same order in every process
  config.hash_seed = 0;
  config.write_bytecode = 0;
  PyStatus status = PyConfig_SetBytesString(&config, &config.program_name, SWARMANOID_PYTHON);
  if (PyStatus_Exception(status) == 0) status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status) != 0)
    throw std::runtime_error(std::string("Python cannot be started: ") + (status.err_msg ? status.err_msg : "?"));
  PyEval_SaveThread();
}

// Returns the module of script_runtime.py. It lives until the process ends.
py::object& Runtime()
{
  static auto* const runtime = new py::object;
  if (*runtime) return *runtime;
  const FloatingPointGuard guard;
  static auto* const definition = new py::module_::module_def{};
  auto natives = py::module_::create_extension_module("swarmanoid_script_robots", nullptr, definition);
  py::class_<ScriptRobots>(natives, "ScriptRobots", py::module_local())
      .def("ids", &ScriptRobots::Ids)
      .def("keys", &ScriptRobots::Keys)
      .def("sensors", &ScriptRobots::Sensors)
      .def("actuators", &ScriptRobots::Actuators)
      .def("columns", &ScriptRobots::Columns)
      .def("row_columns", &ScriptRobots::RowColumns)
      .def("actuator_columns", &ScriptRobots::ActuatorColumns)
      .def("tick", &ScriptRobots::Tick)
      .def("time", &ScriptRobots::Time)
      .def("tick_seconds", &ScriptRobots::TickSeconds)
      .def("begin", &ScriptRobots::Begin)
      .def("read", &ScriptRobots::Read)
      .def("rows", &ScriptRobots::Rows)
      .def("row_ids", &ScriptRobots::RowIds)
      .def("set", &ScriptRobots::Set)
      .def("uniform", &ScriptRobots::Uniform)
      .def("gaussian", &ScriptRobots::Gaussian)
      .def("log", &ScriptRobots::Log);
  const py::object types = py::module_::import("types");
  py::object module = types.attr("ModuleType")("swarmanoid_script_runtime");
  module.attr("natives") = natives;
  const py::object code =
      py::module_::import("builtins").attr("compile")(py::str(kScriptRuntime), "script_runtime.py", "exec");
  py::module_::import("builtins").attr("exec")(code, module.attr("__dict__"));
  *runtime = module;
  return *runtime;
}

// Calls act() with Python's lock. Exceptions of Python become std::runtime_error with file and line of the script.
template <class Act>
auto WithPython(const std::string& file, Act act)
{
  const py::gil_scoped_acquire python;
  try
  {
    return act();
  }
  catch (py::error_already_set& error)
  {
    py::object value = error.value();
    if (error.trace()) value.attr("__traceback__") = error.trace();
    throw std::runtime_error(Runtime().attr("text_of")(value, file).cast<std::string>());
  }
}

DeclaredValue ValueFrom(const py::handle& value)
{
  const auto [kind, text] = value.cast<std::pair<std::string, std::string>>();
  const ParameterType type = kind == "boolean" ? ParameterType::kBoolean
                             : kind == "text"  ? ParameterType::kText
                                               : ParameterType::kNumber;
  return {type, text};
}

std::vector<ParameterSpec> ReadDeclaration(const std::string& file, const std::string& path)
{
  return WithPython(file,
                    [&]
                    {
                      std::vector<ParameterSpec> specs;
                      for (const py::handle declared : Runtime().attr("declaration")(path, file))
                      {
                        const auto [name, declared_fields] = declared.cast<std::pair<std::string, py::list>>();
                        std::vector<DeclaredField> fields;
                        for (const py::handle one : declared_fields)
                        {
                          const auto [field, values] = one.cast<std::pair<std::string, py::list>>();
                          DeclaredField& read = fields.emplace_back(DeclaredField{field});
                          for (const py::handle value : values) read.values.push_back(ValueFrom(value));
                        }
                        specs.push_back(SpecFrom(name, fields));
                      }
                      CompleteDeclaration(specs);
                      return specs;
                    });
}

// Returns the values of the parameters that the script declares, in the types of Python.
py::dict ValuesOf(const std::vector<ParameterSpec>& specs, const TConfigurationTree& tree)
{
  py::dict values;
  for (const ParameterSpec& spec : specs)
  {
    const py::str name(spec.name);
    if (!tree.Value(spec.name))
      values[name] = py::none();  // its default is ""
    else if (spec.type == ParameterType::kNumber)
      values[name] = tree.GetNumber(spec.name);
    else if (spec.type == ParameterType::kInteger)
      values[name] = tree.GetInteger(spec.name);
    else if (spec.type == ParameterType::kBoolean)
      values[name] = tree.GetBoolean(spec.name);
    else if (spec.type == ParameterType::kColour)
      values[name] = tree.GetColour(spec.name);
    else
      values[name] = tree.GetText(spec.name);
  }
  return values;
}

class ScriptGroup
{
public:
  explicit ScriptGroup(const TConfigurationTree& parameters)
      : parameters_(parameters), file_(ShownScript(parameters.GetText(kScriptParameter)))
  {
    const std::string path = parameters.GetText(kScriptParameter);
    const std::vector<ParameterSpec> specs = ReadDeclaration(file_, path);
    WithPython(file_, [&] { script_ = Runtime().attr("Script")(path, file_, ValuesOf(specs, parameters)); });
  }
  ScriptGroup(const ScriptGroup&) = delete;
  ScriptGroup& operator=(const ScriptGroup&) = delete;
  ~ScriptGroup()
  {
    const py::gil_scoped_acquire python;
    script_ = py::object();
  }

  void ControlSteps(std::span<CCI_Controller* const> controllers)
  {
    WithPython(file_,
               [&]
               {
                 if (!std::ranges::equal(controllers, stepped_))
                 {
                   stepped_.assign(controllers.begin(), controllers.end());
                   script_.attr("gather")(ScriptRobots(controllers));
                 }
                 script_.attr("step")();
               });
  }

  void Call(const char* function, CCI_Controller* controller)
  {
    stepped_.clear();
    WithPython(file_, [&] { script_.attr(function)(ScriptRobots(std::span(&controller, 1))); });
  }
  void Remove(const CCI_Controller& controller)
  {
    stepped_.clear();
    WithPython(file_, [&] { script_.attr("remove")(ScriptRobots::KeyOf(controller)); });
  }
  bool HasState(const CCI_Controller& controller) const
  {
    return WithPython(file_, [&] { return script_.attr("has_state")(ScriptRobots::KeyOf(controller)).cast<bool>(); });
  }
  std::string Saved(const CCI_Controller& controller) const
  {
    return WithPython(file_,
                      [&]
                      {
                        return script_.attr("save")(ScriptRobots::KeyOf(controller), controller.GetRobot()->GetTick())
                            .cast<std::string>();
                      });
  }
  void Load(const CCI_Controller& controller, const std::string& saved)
  {
    stepped_.clear();
    WithPython(file_, [&] { script_.attr("load")(ScriptRobots::KeyOf(controller), py::bytes(saved)); });
  }

private:
  const TConfigurationTree parameters_;  // keeps the element alive by which the group is found
  const std::string file_;
  py::object script_;
  std::vector<CCI_Controller*> stepped_;  // the robots of the last step
};

// The groups of this process, by the <parameters> element of their entry of <controllers>.
class Groups
{
public:
  // Returns nullptr if the element has no group.
  std::shared_ptr<ScriptGroup> Find(const TConfigurationTree& parameters)
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(groups_, [](const auto& one) { return one.second.expired(); });
    const auto found = groups_.find(parameters.Node());
    return found == groups_.end() ? nullptr : found->second.lock();
  }
  void Add(const TConfigurationTree& parameters, const std::shared_ptr<ScriptGroup>& group)
  {
    const std::lock_guard lock(mutex_);
    groups_[parameters.Node()] = group;
  }

private:
  std::mutex mutex_;  // never held while Python runs
  std::map<const ConfigurationNode*, std::weak_ptr<ScriptGroup>> groups_;
};

// A host makes its robots in one thread, so no other one makes the same group.
std::shared_ptr<ScriptGroup> GroupOf(const TConfigurationTree& parameters)
{
  static Groups groups;
  std::shared_ptr<ScriptGroup> group = groups.Find(parameters);
  if (group != nullptr) return group;
  group = std::make_shared<ScriptGroup>(parameters);
  groups.Add(parameters, group);
  return group;
}

class PythonScriptController final : public CCI_BatchController
{
public:
  ~PythonScriptController() override
  {
    try
    {
      if (group_ != nullptr) group_->Remove(*this);
    }
    catch (const std::exception&)
    {
      // The rows of the other robots are as they were.
    }
  }

  int Init(const TConfigurationTree t_tree) override
  {
    auto group = GroupOf(t_tree);
    group->Call("add", this);
    group_ = std::move(group);
    return RETURN_OK;
  }
  void ControlSteps(CCI_Batch& robots) override { group_->ControlSteps(robots.Controllers()); }
  void Destroy() override { group_->Call("destroy", this); }

  bool HasState() const override { return group_->HasState(*this); }
  void SaveState(std::ostream& out) const override { out << group_->Saved(*this); }
  void LoadState(std::istream& in) override
  {
    group_->Load(*this, std::string(std::istreambuf_iterator<char>(in), {}));
  }

private:
  std::shared_ptr<ScriptGroup> group_;
};

}  // namespace
}  // namespace swarmanoid::python_scripts

extern "C" __attribute__((visibility("default"))) const swarmanoid::PythonScripts& SwarmanoidPythonScripts()
{
  using namespace swarmanoid::python_scripts;
  if (std::string(Py_GetVersion()).rfind(PY_VERSION_PREFIX, 0) != 0)
    throw std::runtime_error(std::string("controllers in Python need Python ") + PY_VERSION_PREFIX +
                             ", and this program has " + Py_GetVersion());
  if (Py_IsInitialized() == 0) StartPython();
  static const swarmanoid::PythonScripts scripts{[]() -> std::unique_ptr<swarmanoid::CCI_Controller>
                                                 { return std::make_unique<PythonScriptController>(); },
                                                 ReadDeclaration};
  return scripts;
}
