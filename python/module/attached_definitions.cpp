// swarmanoid._module.AttachedRun: the base of python/swarmanoid/attached.py.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "common/messages/control_verbs.h"
#include "common/program/usage_error.h"
#include "common/space/space.h"
#include "python/module/attached_run.h"
#include "python/module/space_rows.h"
#include "visualiser/status_line.h"

namespace py = pybind11;
using namespace py::literals;

namespace swarmanoid::python
{
namespace
{

// Returns a copy that cannot be written.
template <class Numbers>
py::array Frozen(const Numbers& values)
{
  py::array_t<double> copy(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), copy.mutable_data());
  copy.attr("setflags")("write"_a = false);
  return copy;
}

py::object StateOf(AttachedRun& run)
{
  py::dict state;
  const bool has_one = run.WithState(
      [&](const CSwarmanoidSpace& space, const SpaceSnapshot& snapshot, std::uint64_t number)
      {
        state["number"] = number;
        const PoseArrays& poses = space.Poses();
        state["tick"] = space.GetTick();
        state["time"] = space.GetTime();
        state["last"] = snapshot.last;
        state["real_time_factor"] = snapshot.real_time_factor;
        state["hash"] = fmt::format("{:016x}", space.Hash());
        state["x"] = Frozen(poses.x);
        state["y"] = Frozen(poses.y);
        state["z"] = Frozen(poses.z);
        state["qx"] = Frozen(poses.qx);
        state["qy"] = Frozen(poses.qy);
        state["qz"] = Frozen(poses.qz);
        state["qw"] = Frozen(poses.qw);
        state["attributes"] = Frozen(space.Attributes().Values());
      });
  return has_one ? py::object(state) : py::none();
}

// The table of requests, from which python/swarmanoid/attached.py makes methods.
py::list VerbRows()
{
  constexpr const char* kTypes[] = {"name", "choice", "whole", "change", "number", "pose"};
  py::list rows;
  for (const ControlVerb& verb : ControlVerbs())
  {
    if (verb.who > Asker::kMember) continue;
    py::list parameters;
    for (const ControlParameter& parameter : verb.parameters)
      parameters.append(py::dict("name"_a = parameter.name, "type"_a = kTypes[static_cast<std::size_t>(parameter.type)],
                                 "unit"_a = parameter.unit, "minimum"_a = parameter.minimum,
                                 "maximum"_a = parameter.maximum, "optional"_a = parameter.optional,
                                 "is_option"_a = parameter.is_option));
    rows.append(
        py::dict("name"_a = verb.name, "form"_a = FormOf(verb), "help"_a = verb.help, "parameters"_a = parameters));
  }
  return rows;
}

py::dict StatusOf(AttachedRun& run)
{
  const RunStatus status = run.Status();
  py::list processes;
  for (const ProcessStatus& process : status.processes)
    processes.append(py::dict("name"_a = process.name, "process"_a = process.process, "tick"_a = process.tick,
                              "late_s"_a = process.late_s, "doing"_a = process.doing));
  return py::dict("phase"_a = PhaseName(status.phase), "tick"_a = status.tick, "speed_wanted"_a = status.speed_wanted,
                  "real_time_factor"_a = status.real_time_factor, "ticks_per_second"_a = status.ticks_per_second,
                  "ended"_a = status.ended, "processes"_a = processes);
}

py::dict DevicesOf(const std::vector<DeviceStatus>& devices)
{
  py::dict all;
  for (const DeviceStatus& device : devices)
  {
    py::list names;
    py::list units;
    std::vector<double> values;
    for (const CCI_Reading& reading : device.readings)
    {
      names.append(reading.name);
      units.append(reading.unit);
      values.push_back(reading.value);
    }
    all[device.type.c_str()] = py::make_tuple(names, units, Frozen(values));
  }
  return all;
}

py::dict RobotOf(AttachedRun& run, std::uint32_t entity, double timeout_s)
{
  const RobotStatus robot = run.Robot(entity, timeout_s);
  return py::dict("tick"_a = robot.tick, "controller"_a = robot.controller, "text"_a = robot.text,
                  "state"_a = robot.state, "sensors"_a = DevicesOf(robot.sensors),
                  "actuators"_a = DevicesOf(robot.actuators));
}

std::unique_ptr<AttachedRun> Attach(const std::string& experiment, std::optional<int> domain, const std::string& key,
                                    const std::string& network_interface, const std::vector<std::string>& peers,
                                    const std::string& discovery_server, bool insecure, double views, double wait_s,
                                    double timeout_s)
{
  AttachedRunOptions options;
  options.experiment = experiment;
  options.domain = domain;
  options.bus.key_file = key;
  // If other machines are named, the run is not restricted to this one, as for the command.
  options.bus.network_interface = network_interface;
  options.bus.peers = peers;
  options.bus.discovery_server = discovery_server;
  if (network_interface.empty())
    options.bus.network_interface = peers.empty() && discovery_server.empty() ? "lo" : "all";
  options.bus.insecure = insecure;
  options.views = views;
  options.wait_s = wait_s;
  options.timeout_s = timeout_s;
  return std::make_unique<AttachedRun>(options);
}

void TranslateExceptions(py::module_& module)
{
  py::register_exception<RunError>(module, "RunError", PyExc_RuntimeError);
  py::register_exception_translator(
      [](std::exception_ptr thrown)
      {
        try
        {
          if (thrown) std::rethrow_exception(thrown);
        }
        catch (const TimeOver& error)
        {
          PyErr_SetString(PyExc_TimeoutError, error.what());
        }
        catch (const UsageError& error)
        {
          PyErr_SetString(PyExc_ValueError, error.what());
        }
        catch (const BusError& error)
        {
          const py::object type = py::module_::import("swarmanoid._module").attr("RunError");
          PyErr_SetString(type.ptr(), error.what());
        }
      });
}

}  // namespace

void DefineAttachedRun(py::module_& module)
{
  TranslateExceptions(module);
  module.def("control_verbs", &VerbRows);
  py::class_<AttachedRun>(module, "AttachedRun")
      .def(py::init(&Attach), "experiment"_a, "domain"_a, "key"_a, "interface"_a, "peers"_a, "discovery_server"_a,
           "insecure"_a, "views"_a, "wait_s"_a, "timeout_s"_a)
      .def_property_readonly("experiment", [](const AttachedRun& self) { return self.Choice().experiment; })
      .def_property_readonly("domain", [](const AttachedRun& self) { return self.Choice().domain; })
      .def_property_readonly("seed", [](AttachedRun& self) { return self.World().seed; })
      .def_property_readonly("tick_seconds", [](AttachedRun& self) { return self.World().tick_seconds; })
      .def_property_readonly("max_ticks",
                             [](const AttachedRun& self) { return self.Space().GetExperiment().max_clock; })
      .def_property_readonly("ids", [](const AttachedRun& self) { return IdsOf(self.Space()); })
      .def_property_readonly("kinds", [](const AttachedRun& self) { return KindsOf(self.Space()); })
      .def("slot", [](const AttachedRun& self, std::size_t index, const std::string& name)
           { return SlotOf(self.Space(), index, name); })
      .def("presence_slot", [](const AttachedRun& self, std::size_t index) { return self.Space().PresenceSlot(index); })
      .def_property_readonly("states", &AttachedRun::States)
      .def("state", &StateOf)
      .def("wait", &AttachedRun::Wait, "taken"_a, "stale"_a, "tick"_a, "timeout_s"_a)
      .def(
          "control",
          [](AttachedRun& self, const std::vector<std::string>& words,
             const std::map<std::string, std::string>& options)
          {
            const ControlReplyMessage reply = self.Control(words, options);
            if (!reply.ok) throw py::value_error(reply.text);
            return py::make_tuple(reply.tick, reply.text);
          },
          "words"_a, "options"_a)
      .def("status", &StatusOf)
      .def("robot", &RobotOf, "entity"_a, "timeout_s"_a)
      .def_property_readonly("is_over", &AttachedRun::IsOver)
      .def_property_readonly("failure", &AttachedRun::Failure)
      .def("close", &AttachedRun::Close);
}

}  // namespace swarmanoid::python
