// A controller in Python is one object of the user's class for each robot. The thread that steps the simulation does
// not hold Python's lock; every call here takes it for its duration, and the objects are destroyed under it as well.
// The state of a controller is what get_state() returns, as a pickle; without it a run with this controller cannot be
// saved.
#include "python/module/python_controller.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <istream>
#include <iterator>
#include <ostream>

namespace py = pybind11;

namespace swarmanoid::python
{
namespace
{

template <class Map>
[[noreturn]] void Refuse(const CCI_Robot& robot, const char* what, const std::string& type, const Map& known)
{
  std::string text = "the robot '" + robot.GetId() + "' has no " + what + " '" + type + "'; it has:";
  for (const auto& entry : known) text += " " + entry.first;
  throw py::key_error(text);
}

// Calls the object that a user's class made for a robot. The caller that steps the simulation has released Python's
// lock.
class PythonController : public CCI_Controller
{
public:
  explicit PythonController(py::object type) : type_(std::move(type)) {}
  ~PythonController() override
  {
    const py::gil_scoped_acquire python;
    object_ = robot_ = step_ = type_ = py::object();
  }

  int Init(const TConfigurationTree tree) override
  {
    const py::gil_scoped_acquire python;
    object_ = type_();
    robot_ = py::cast(PythonRobot(*GetRobot()));
    if (py::hasattr(object_, "init")) object_.attr("init")(robot_, ToPython(tree));
    step_ = object_.attr("control_step");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    const py::gil_scoped_acquire python;
    step_(robot_);
  }
  void Destroy() override
  {
    const py::gil_scoped_acquire python;
    if (object_ && py::hasattr(object_, "destroy")) object_.attr("destroy")(robot_);
  }

  bool HasState() const override
  {
    const py::gil_scoped_acquire python;
    return py::hasattr(object_, "get_state") && py::hasattr(object_, "set_state");
  }
  void SaveState(std::ostream& out) const override
  {
    const py::gil_scoped_acquire python;
    out << std::string(py::module_::import("pickle").attr("dumps")(object_.attr("get_state")()).cast<py::bytes>());
  }
  void LoadState(std::istream& in) override
  {
    const py::gil_scoped_acquire python;
    const std::string text(std::istreambuf_iterator<char>(in), {});
    object_.attr("set_state")(py::module_::import("pickle").attr("loads")(py::bytes(text)));
  }
  // It has all of them as a dict.
  bool ReadsParametersLater() const override { return true; }
  std::string StatusText() const override
  {
    const py::gil_scoped_acquire python;
    return py::hasattr(object_, "status") ? py::str(object_.attr("status")).cast<std::string>() : std::string();
  }

private:
  py::object type_, object_, robot_, step_;
};

}  // namespace

PythonRobot::PythonRobot(CCI_Robot& robot) : robot_(robot)
{
  for (const auto& [type, sensor] : SensorsOf(robot)) sensors_[type] = SensorReader(type, *sensor);
  for (const auto& [type, actuator] : ActuatorsOf(robot))
    if (std::vector<std::string> columns = NamesOf(actuator->Columns()); !columns.empty())
      actuators_[type] = {actuator, std::move(columns)};
}

const SensorReader& PythonRobot::ReaderOf(const std::string& type) const
{
  const auto found = sensors_.find(type);
  if (found == sensors_.end()) Refuse(robot_, "sensor", type, sensors_);
  return found->second;
}

const SensorReader& PythonRobot::RowReaderOf(const std::string& type) const
{
  const SensorReader& sensor = ReaderOf(type);
  if (sensor.Rows().empty())
    throw py::key_error("the sensor '" + type + "' of the robot '" + robot_.GetId() +
                        "' has no rows; read its columns");
  return sensor;
}

py::object PythonRobot::Read(const std::string& type) const
{
  const SensorReader& sensor = ReaderOf(type);
  if (sensor.Columns().empty() && !sensor.Rows().empty()) return Rows(type);
  std::vector<double> values;
  sensor.ReadColumns(values);
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::object PythonRobot::Rows(const std::string& type) const
{
  const SensorReader& sensor = RowReaderOf(type);
  std::vector<double> rows;
  sensor.ReadRows(rows);
  const auto width = static_cast<py::ssize_t>(sensor.Rows().size());
  py::array_t<double> values({static_cast<py::ssize_t>(rows.size()) / width, width});
  std::copy(rows.begin(), rows.end(), values.mutable_data());
  return values;
}

std::vector<std::string> PythonRobot::RowIds(const std::string& type) const { return RowReaderOf(type).RowIds(); }

void PythonRobot::Set(const std::string& type, const std::vector<double>& values)
{
  const auto found = actuators_.find(type);
  if (found == actuators_.end()) Refuse(robot_, "actuator", type, ActuatorsOf(robot_));
  const std::size_t width = found->second.columns.size();
  if (values.size() != width)
    throw py::value_error("the actuator '" + type + "' takes " + std::to_string(width) + " numbers, not " +
                          std::to_string(values.size()));
  for (const double value : values)
    if (!std::isfinite(value))
      throw py::value_error("the actuator '" + type + "' was told what is not a finite number");
  found->second.device->SetColumns(values);
}

std::vector<std::string> PythonRobot::ColumnsOfSensor(const std::string& type) const
{
  const SensorReader& sensor = ReaderOf(type);
  return sensor.Columns().empty() ? sensor.Rows() : sensor.Columns();
}

std::vector<std::string> PythonRobot::ColumnsOfRows(const std::string& type) const { return RowReaderOf(type).Rows(); }

std::vector<std::string> PythonRobot::ColumnsOfActuator(const std::string& type) const
{
  if (const auto found = actuators_.find(type); found != actuators_.end()) return found->second.columns;
  Refuse(robot_, "actuator", type, ActuatorsOf(robot_));
}

void RegisterPythonController(const std::string& label, py::object type)
{
  if (!py::hasattr(type, "control_step"))
    throw py::type_error("the class of the controller '" + label + "' has no method control_step(self, robot)");
  // A class that is defined again, as in a notebook, replaces the first one.
  static auto* const types = new std::map<std::string, py::object>;
  const bool is_new = !types->contains(label);
  (*types)[label] = std::move(type);
  if (!is_new) return;
  PluginRegistry<CCI_Controller>::Instance().Add(
      PluginDescription{.label = label, .brief = "a controller in Python", .declares_parameters = false},
      [label]() -> std::unique_ptr<CCI_Controller>
      {
        const py::gil_scoped_acquire python;
        return std::make_unique<PythonController>(types->at(label));
      });
}

py::object ToPython(const TConfigurationTree& tree)
{
  const ConfigurationNode* const node = tree.Node();
  py::dict values;
  if (node == nullptr) return values;
  const auto add = [&](const std::string& name, py::object value)
  {
    if (!values.contains(name.c_str()))
      values[name.c_str()] = value;
    else if (py::isinstance<py::list>(values[name.c_str()]))
      values[name.c_str()].cast<py::list>().append(value);
    else
    {
      py::list list;
      list.append(values[name.c_str()]);
      list.append(value);
      values[name.c_str()] = list;
    }
  };
  for (const ConfigurationNode::Attribute& attribute : node->attributes) add(attribute.name, py::str(attribute.value));
  for (const TConfigurationTree& child : tree.Children())
  {
    const ConfigurationNode& inner = *child.Node();
    const bool is_leaf = inner.attributes.empty() && inner.children.empty();
    add(inner.name, is_leaf ? py::object(py::str(inner.text)) : ToPython(child));
  }
  return values;
}

}  // namespace swarmanoid::python
