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
  for (CCI_Controller* const controller : controllers)
  {
    batch_.Add(*controller);
    keys_.push_back(KeyOf(*controller));
  }
}

const CCI_Sensor& ScriptRobots::Sensor(std::size_t robot, const std::string& type) const
{
  if (!batch_.Robot(robot).HasSensor(type)) Unknown("sensor", type, Sensors());
  return *batch_.Robot(robot).GetSensor(type);
}

const CCI_Actuator& ScriptRobots::Actuator(const std::string& type) const
{
  if (!batch_.Robot(0).HasActuator(type)) Unknown("actuator", type, Actuators());
  return *batch_.Robot(0).GetActuator(type);
}

std::vector<std::string> ScriptRobots::Ids() const
{
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < batch_.Size(); ++k) ids.push_back(batch_.Robot(k).GetId());
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
  return NamesOf(Actuator(actuator).Columns());
}

Array ScriptRobots::Read(const std::string& sensor)
{
  // A sensor that has rows alone is read as an array without columns.
  if (Sensor(0, sensor).Declared().readings.empty()) return MakeArray(batch_.Size(), 0);
  const CCI_Readings readings = batch_.Readings(sensor);
  Array array = MakeArray(batch_.Size(), readings.Columns());
  double* next = array.mutable_data();
  for (std::size_t k = 0; k < batch_.Size(); ++k) next = std::ranges::copy(readings[k], next).out;
  return array;
}

std::vector<Array> ScriptRobots::Rows(const std::string& sensor) const
{
  std::vector<Array> all;
  std::vector<double> values;
  for (std::size_t k = 0; k < batch_.Size(); ++k)
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
  std::vector<std::vector<std::string>> all(batch_.Size());
  for (std::size_t k = 0; k < batch_.Size(); ++k) Sensor(k, sensor).ReadRowIds(all[k]);
  return all;
}

void ScriptRobots::Set(const std::string& actuator, const Array& values)
{
  const bool has_columns = !Actuator(actuator).Declared().settings.empty();
  const CCI_Commands commands = has_columns ? batch_.Commands(actuator) : CCI_Commands({}, 0);
  const std::size_t width = commands.Columns();
  if (values.ndim() != 2 || values.shape(0) != static_cast<py::ssize_t>(batch_.Size()) ||
      values.shape(1) != static_cast<py::ssize_t>(width))
    throw py::value_error("the actuator '" + actuator + "' takes an array of " + std::to_string(batch_.Size()) +
                          " robots and " + std::to_string(width) + " columns");
  for (std::size_t k = 0; k < batch_.Size(); ++k)
  {
    const std::span row(values.data() + k * width, width);
    if (std::ranges::all_of(row, [](double value) { return std::isnan(value); })) continue;
    const auto wrong = std::ranges::find_if_not(row, [](double value) { return std::isfinite(value); });
    if (wrong != row.end())
      throw py::value_error("column " + std::to_string(wrong - row.begin()) + " of the actuator '" + actuator +
                            "' of the robot '" + batch_.Robot(k).GetId() + "' is not finite");
    std::ranges::copy(row, commands[k].begin());
  }
  batch_.SetCommands();
}

template <class Draw>
Array ScriptRobots::Drawn(std::size_t columns, Draw draw) const
{
  Array numbers = MakeArray(batch_.Size(), columns);
  double* next = numbers.mutable_data();
  for (std::size_t k = 0; k < batch_.Size(); ++k)
    for (std::size_t i = 0; i < columns; ++i) *next++ = draw(batch_.Robot(k).GetRandom());
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

void ScriptRobots::Log(std::size_t robot, const std::string& text) const
{
  if (robot >= batch_.Size()) throw py::index_error("there is no robot " + std::to_string(robot));
  batch_.Robot(robot).Log(text);
}

}  // namespace swarmanoid::python_scripts
