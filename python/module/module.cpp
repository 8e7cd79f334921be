// The module swarmanoid._module; what users import is swarmanoid (python/swarmanoid/__init__.py), which documents it.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include "common/activity/failure_report.h"
#include "common/configuration/configuration_tree.h"
#include "common/math/elementary.h"
#include "common/math/reproducible_math.h"
#include "common/space/space.h"
#include "common/version/version.h"
#include "python/module/attached_run.h"
#include "python/module/python_controller.h"
#include "python/module/python_simulation.h"
#include "python/module/space_rows.h"
#include "space_server/experiment_functions.h"
#include "studies/tables/study_store.h"

namespace py = pybind11;
using namespace py::literals;

namespace swarmanoid::python
{
namespace
{

REGISTER_CONTROLLER(ExternalController, "external_controller", "robots that a program in Python reads and steers")

// A view of numbers that `owner` keeps alive.
template <class Owner>
py::array View(const Owner& owner, const double* data, std::vector<py::ssize_t> shape, bool writable)
{
  py::array_t<double> view(std::move(shape), data, py::cast(owner));
  if (!writable) view.attr("setflags")("write"_a = false);
  return view;
}

py::dict Arrays(const std::shared_ptr<Simulation>& simulation, ExternalGroup& group,
                std::map<std::string, DeviceArray>& arrays, bool writable)
{
  py::dict views;
  for (auto& [type, array] : arrays)
    views[type.c_str()] =
        View(simulation, array.values.data(),
             {static_cast<py::ssize_t>(group.Size()), static_cast<py::ssize_t>(array.columns.size())}, writable);
  return views;
}

// The robots of one external controller, for Python.
struct GroupHandle
{
  std::shared_ptr<Simulation> simulation;
  ExternalGroup* group;

  py::dict Columns() const
  {
    // A sensor and an actuator may have one type: then these are the columns of the sensor.
    py::dict columns;
    for (const auto& [type, array] : group->Actuators()) columns[type.c_str()] = array.columns;
    for (const auto& [type, names] : group->RowSensors()) columns[type.c_str()] = names;
    for (const auto& [type, array] : group->Sensors()) columns[type.c_str()] = array.columns;
    return columns;
  }
  py::dict ActuatorColumns() const
  {
    py::dict columns;
    for (const auto& [type, array] : group->Actuators()) columns[type.c_str()] = array.columns;
    return columns;
  }
  const std::vector<std::string>& RowColumns(const std::string& type) const
  {
    const auto found = group->RowSensors().find(type);
    if (found != group->RowSensors().end()) return found->second;
    std::string known;
    for (const auto& [name, columns] : group->RowSensors()) known += " " + name;
    throw py::key_error("no sensor '" + type + "' whose readings are rows; there are:" + known);
  }
  std::vector<std::vector<std::string>> RowIds(const std::string& type) const
  {
    RowColumns(type);
    std::vector<std::vector<std::string>> ids;
    for (std::size_t robot = 0; robot < group->Size(); ++robot) ids.push_back(group->RowIds(robot, type));
    return ids;
  }
  py::list Rows(const std::string& type) const
  {
    const auto width = static_cast<py::ssize_t>(RowColumns(type).size());
    py::list all;
    for (std::size_t robot = 0; robot < group->Size(); ++robot)
    {
      const std::vector<double> rows = group->Rows(robot, type);
      py::array_t<double> values({static_cast<py::ssize_t>(rows.size()) / width, width});
      std::copy(rows.begin(), rows.end(), values.mutable_data());
      all.append(std::move(values));
    }
    return all;
  }
};

Pose PoseOf(const std::array<double, 3>& position, const std::array<double, 3>& orientation_degrees)
{
  const auto radians = [](double degrees) { return DegreesToRadians(degrees); };
  return {{position[0], position[1], position[2]},
          QuaternionFromEuler(
              {radians(orientation_degrees[0]), radians(orientation_degrees[1]), radians(orientation_degrees[2])})};
}

std::string HashText(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

template <std::vector<double> PoseArrays::*kMember>
py::array PoseView(const std::shared_ptr<Simulation>& simulation)
{
  const std::vector<double>& values = simulation->Space().Poses().*kMember;
  return View(simulation, values.data(), {static_cast<py::ssize_t>(values.size())}, false);
}

void DefineSimulation(py::module_& module)
{
  using Handle = std::shared_ptr<Simulation>;
  py::class_<GroupHandle>(module, "Robots")
      .def_property_readonly("ids", [](const GroupHandle& self) { return self.group->Ids(); })
      .def_property_readonly("sensors", [](const GroupHandle& self)
                             { return Arrays(self.simulation, *self.group, self.group->Sensors(), false); })
      .def_property_readonly("actuators", [](const GroupHandle& self)
                             { return Arrays(self.simulation, *self.group, self.group->Actuators(), true); })
      .def_property_readonly("columns", &GroupHandle::Columns)
      .def_property_readonly("actuator_columns", &GroupHandle::ActuatorColumns)
      .def_property_readonly("row_columns", [](const GroupHandle& self) { return self.group->RowSensors(); })
      .def("rows", &GroupHandle::Rows, "sensor"_a)
      .def("row_ids", &GroupHandle::RowIds, "sensor"_a)
      .def("__len__", [](const GroupHandle& self) { return self.group->Size(); });

  py::class_<Simulation, Handle>(module, "Simulation")
      .def(py::init(
               [](const std::string& file, const Simulation::Settings& settings, const std::string& output,
                  bool visualisations, unsigned threads, std::uint64_t checkpoint_every, const std::string& restore,
                  const std::string& hash_log, double real_time)
               {
                 SimulatorOptions options;
                 options.output_folder = output;
                 options.visualisations = visualisations;
                 options.threads = threads;
                 options.checkpoint_every = checkpoint_every;
                 options.restore_file = restore;
                 options.hash_log = hash_log;
                 options.real_time_factor = real_time;
                 return std::make_shared<Simulation>(file, settings, options);
               }),
           "file"_a, "settings"_a, "output"_a, "visualisations"_a, "threads"_a, "checkpoint_every"_a, "restore"_a,
           "hash_log"_a, "real_time"_a)
      .def("step", &Simulation::Step, "ticks"_a)
      .def("sense", &Simulation::Sense)
      .def("close", &Simulation::Close)
      .def("finish",
           [](Simulation& self)
           {
             const RunSummary& summary = self.Finish();
             return py::dict("ticks"_a = summary.ticks, "entities"_a = summary.entities,
                             "hash"_a = HashText(summary.hash), "wall_s"_a = summary.wall_s,
                             "real_time_factor"_a = summary.real_time_factor, "failed"_a = summary.failed);
           })
      .def_property_readonly("tick", [](const Simulation& self) { return self.Space().GetTick(); })
      .def_property_readonly("time", [](const Simulation& self) { return self.Space().GetTime(); })
      .def_property_readonly("tick_seconds", [](const Simulation& self) { return self.Space().GetTickSeconds(); })
      .def_property_readonly("max_ticks", [](const Simulation& self) { return self.Space().GetExperiment().max_clock; })
      .def_property_readonly("arena",
                             [](const Simulation& self)
                             {
                               const Vector3& size = self.Space().GetExperiment().arena_size;
                               return py::make_tuple(size.x(), size.y(), size.z());
                             })
      .def("hash", [](const Simulation& self) { return HashText(self.Space().Hash()); })
      .def_property_readonly("ids", [](const Simulation& self) { return IdsOf(self.Space()); })
      .def_property_readonly("kinds", [](const Simulation& self) { return KindsOf(self.Space()); })
      .def_property_readonly("x", &PoseView<&PoseArrays::x>)
      .def_property_readonly("y", &PoseView<&PoseArrays::y>)
      .def_property_readonly("z", &PoseView<&PoseArrays::z>)
      .def_property_readonly("qx", &PoseView<&PoseArrays::qx>)
      .def_property_readonly("qy", &PoseView<&PoseArrays::qy>)
      .def_property_readonly("qz", &PoseView<&PoseArrays::qz>)
      .def_property_readonly("qw", &PoseView<&PoseArrays::qw>)
      .def_property_readonly("attributes",
                             [](const Handle& self)
                             {
                               const std::span<const double> values = self->Space().Attributes().Values();
                               return View(self, values.data(), {static_cast<py::ssize_t>(values.size())}, false);
                             })
      .def("slot", [](const Simulation& self, std::size_t index, const std::string& name)
           { return SlotOf(self.Space(), index, name); })
      .def("presence_slot", [](const Simulation& self, std::size_t index) { return self.Space().PresenceSlot(index); })
      .def("move",
           [](Simulation& self, const std::string& id, const std::array<double, 3>& position,
              const std::array<double, 3>& orientation, bool overlap) {
             self.Editor().MoveEntity(id, PoseOf(position, orientation),
                                      overlap ? EOccupied::kOverlap : EOccupied::kRefuse);
           })
      .def("add", [](Simulation& self, const std::string& id, const std::array<double, 3>& position,
                     const std::array<double, 3>& orientation)
           { return self.Editor().AddEntity(id, PoseOf(position, orientation)); })
      .def("remove", [](Simulation& self, const std::string& id) { self.Editor().RemoveEntity(id); })
      .def("set_attribute", [](Simulation& self, const std::string& id, const std::string& name, double value,
                               int element) { self.Editor().SetAttribute(id, name, value, element); })
      .def_property_readonly("robots",
                             [](const Handle& self)
                             {
                               py::dict groups;
                               for (auto& [id, group] : self->Robots().Groups())
                                 groups[id.c_str()] = GroupHandle{self, &group};
                               return groups;
                             });
}

void DefineController(py::module_& module)
{
  py::class_<PythonRobot>(module, "Robot")
      .def_property_readonly("id", [](const PythonRobot& self) { return self.Robot().GetId(); })
      .def_property_readonly("kind", [](const PythonRobot& self) { return self.Robot().GetKind(); })
      .def_property_readonly("tick", [](const PythonRobot& self) { return self.Robot().GetTick(); })
      .def_property_readonly("time", [](const PythonRobot& self) { return self.Robot().GetTime(); })
      .def_property_readonly("tick_seconds", [](const PythonRobot& self) { return self.Robot().GetTickSeconds(); })
      .def("read", &PythonRobot::Read, "sensor"_a)
      .def("rows", &PythonRobot::Rows, "sensor"_a)
      .def("row_ids", &PythonRobot::RowIds, "sensor"_a)
      .def("row_columns", &PythonRobot::ColumnsOfRows, "sensor"_a)
      .def("set", &PythonRobot::Set, "actuator"_a, "values"_a)
      .def(
          "columns",
          [](const PythonRobot& self, const std::string& device)
          { return self.Robot().HasSensor(device) ? self.ColumnsOfSensor(device) : self.ColumnsOfActuator(device); },
          "device"_a)
      .def("uniform", &PythonRobot::Uniform, "low"_a, "high"_a)
      .def(
          "log", [](const PythonRobot& self, const std::string& text) { self.Robot().Log(text); }, "text"_a);
  module.def(
      "check_study",
      [](const std::string& folder)
      {
        try
        {
          StudyStore::RequireWhole(folder);
        }
        catch (const StudyStoreError& error)
        {
          throw py::value_error(error.what());
        }
      },
      "folder"_a);
  module.def("register_controller", &RegisterPythonController, "label"_a, "type"_a);
}

}  // namespace

PYBIND11_MODULE(_module, module)
{
  module.attr("__version__") = Version();
  SetOwnScope();  // __init__.py has loaded this so
  py::register_exception<ConfigurationError>(module, "ConfigurationError", PyExc_ValueError);
  py::register_exception<ActivityError>(module, "ActivityError", PyExc_RuntimeError);
  DefineSimulation(module);
  DefineAttachedRun(module);
  DefineController(module);
}

}  // namespace swarmanoid::python
