#include "controller_host/scripts/python/script_robots.h"

#include <algorithm>
#include <cmath>

namespace py = pybind11;

namespace swarmanoid::python_scripts
{
namespace
{

std::vector<std::string> NamesOf(const std::vector<CCI_Column>& columns)
{
  std::vector<std::string> names;
  for (const CCI_Column& column : columns) names.push_back(column.Title());
  return names;
}

Array MakeArray(std::size_t rows, std::size_t columns)
{
  return Array({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
}

[[noreturn]] void Unknown(const std::string& what, const std::string& type, const std::vector<std::string>& known)
{
  std::string text = "the robots have no " + what + " '" + type + "'; they have:";
  for (const std::string& one : known) text += " " + one;
  throw py::key_error(text);
}

}  // namespace

ScriptRobots::ScriptRobots(std::span<CCI_Controller* const> controllers)
{
  for (const CCI_Controller* controller : controllers)
  {
    robots_.push_back(controller->GetRobot());
    keys_.push_back(KeyOf(*controller));
  }
}

const CCI_Sensor& ScriptRobots::Sensor(std::size_t robot, const std::string& type) const
{
  if (!robots_[robot]->HasSensor(type)) Unknown("sensor", type, Sensors());
  return *robots_[robot]->GetSensor(type);
}

CCI_Actuator& ScriptRobots::Actuator(std::size_t robot, const std::string& type) const
{
  if (!robots_[robot]->HasActuator(type)) Unknown("actuator", type, Actuators());
  return *robots_[robot]->GetActuator(type);
}

std::vector<std::string> ScriptRobots::Ids() const
{
  std::vector<std::string> ids;
  for (const CCI_Robot* robot : robots_) ids.push_back(robot->GetId());
  return ids;
}

std::vector<std::string> ScriptRobots::Columns(const std::string& sensor) const
{
  return NamesOf(Sensor(0, sensor).Columns());
}
std::vector<std::string> ScriptRobots::RowColumns(const std::string& sensor) const
{
  return NamesOf(Sensor(0, sensor).Rows());
}
std::vector<std::string> ScriptRobots::ActuatorColumns(const std::string& actuator) const
{
  return NamesOf(Actuator(0, actuator).Columns());
}

Array ScriptRobots::Read(const std::string& sensor) const
{
  std::vector<double> values;
  Array array;
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    values.clear();
    Sensor(k, sensor).ReadColumns(values);
    if (k == 0) array = MakeArray(robots_.size(), values.size());
    if (static_cast<py::ssize_t>(values.size()) != array.shape(1))
      throw py::value_error("the sensor '" + sensor + "' has columns of another number for the robot '" +
                            robots_[k]->GetId() + "'; give each kind of robot a controller of its own");
    std::copy(values.begin(), values.end(), array.mutable_data() + k * values.size());
  }
  return array;
}

std::vector<Array> ScriptRobots::Rows(const std::string& sensor) const
{
  std::vector<Array> all;
  std::vector<double> values;
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const std::size_t width = Sensor(k, sensor).Rows().size();
    if (width == 0) throw py::key_error("the sensor '" + sensor + "' has no rows; read its columns");
    values.clear();
    Sensor(k, sensor).ReadRows(values);
    all.push_back(MakeArray(values.size() / width, width));
    std::copy(values.begin(), values.end(), all.back().mutable_data());
  }
  return all;
}

std::vector<std::vector<std::string>> ScriptRobots::RowIds(const std::string& sensor) const
{
  std::vector<std::vector<std::string>> all(robots_.size());
  for (std::size_t k = 0; k < robots_.size(); ++k) Sensor(k, sensor).ReadRowIds(all[k]);
  return all;
}

void ScriptRobots::Set(const std::string& actuator, const Array& values)
{
  const std::size_t width = Actuator(0, actuator).Columns().size();
  if (values.ndim() != 2 || values.shape(0) != static_cast<py::ssize_t>(robots_.size()) ||
      values.shape(1) != static_cast<py::ssize_t>(width))
    throw py::value_error("the actuator '" + actuator + "' takes an array of " + std::to_string(robots_.size()) +
                          " robots and " + std::to_string(width) + " columns");
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    const std::span row(values.data() + k * width, width);
    if (std::ranges::all_of(row, [](double value) { return std::isnan(value); })) continue;
    const auto wrong = std::ranges::find_if_not(row, [](double value) { return std::isfinite(value); });
    if (wrong != row.end())
      throw py::value_error("column " + std::to_string(wrong - row.begin()) + " of the actuator '" + actuator +
                            "' of the robot '" + robots_[k]->GetId() + "' is not finite");
    Actuator(k, actuator).SetColumns(row);
  }
}

template <class Draw>
Array ScriptRobots::Drawn(std::size_t columns, Draw draw) const
{
  Array numbers = MakeArray(robots_.size(), columns);
  double* next = numbers.mutable_data();
  for (CCI_Robot* robot : robots_)
    for (std::size_t i = 0; i < columns; ++i) *next++ = draw(robot->GetRandom());
  return numbers;
}

Array ScriptRobots::Uniform(double low, double high, std::size_t columns) const
{
  return Drawn(columns, [&](RandomStream& random) { return random.Uniform(low, high); });
}

Array ScriptRobots::Gaussian(double mean, double deviation, std::size_t columns) const
{
  return Drawn(columns, [&](RandomStream& random) { return random.Gaussian(mean, deviation); });
}

}  // namespace swarmanoid::python_scripts
