// Robots of a script in Python, as arrays with a row for each robot.
#pragma once

#include <pybind11/numpy.h>

#include <span>
#include <string>
#include <vector>

#include "common/control_interface/ci_batch_controller.h"

namespace swarmanoid::python_scripts
{

using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// The robots live as long as their controllers. Functions throw KeyError for a device that the robots do not have.
class ScriptRobots
{
public:
  explicit ScriptRobots(std::span<CCI_Controller* const> controllers);

  std::vector<std::string> Ids() const;
  // Returns a number for each robot that no other controller has.
  const std::vector<std::uintptr_t>& Keys() const { return keys_; }
  static std::uintptr_t KeyOf(const CCI_Controller& controller)
  {
    return reinterpret_cast<std::uintptr_t>(&controller);
  }
  std::vector<std::string> Sensors() const { return batch_.Robot(0).SensorTypes(); }
  std::vector<std::string> Actuators() const { return batch_.Robot(0).ActuatorTypes(); }
  // Return the names of columns with their units.
  std::vector<std::string> Columns(const std::string& sensor) const;
  std::vector<std::string> RowColumns(const std::string& sensor) const;
  std::vector<std::string> ActuatorColumns(const std::string& actuator) const;

  std::uint64_t Tick() const { return batch_.Robot(0).GetTick(); }
  double Time() const { return batch_.Robot(0).GetTime(); }
  double TickSeconds() const { return batch_.Robot(0).GetTickSeconds(); }

  // Begins a step: Read returns the readings of that step.
  void Begin() { batch_.Begin(); }
  // Returns the readings of the columns.
  Array Read(const std::string& sensor);
  // Return the rows of each robot, and the ids of the entities that they are about.
  std::vector<Array> Rows(const std::string& sensor) const;
  std::vector<std::vector<std::string>> RowIds(const std::string& sensor) const;
  // Sets the actuators. A row of NaN leaves one as it is. Throws ValueError for other numbers that are not finite.
  void Set(const std::string& actuator, const Array& values);

  // Return numbers from the random stream of each robot.
  Array Uniform(double low, double high, std::size_t columns) const;
  Array Gaussian(double mean, double deviation, std::size_t columns) const;

  void Log(std::size_t robot, const std::string& text) const;

private:
  const CCI_Sensor& Sensor(std::size_t robot, const std::string& type) const;
  const CCI_Actuator& Actuator(const std::string& type) const;
  template <class Draw>
  Array Drawn(std::size_t columns, Draw draw) const;

  CCI_Batch batch_;
  std::vector<std::uintptr_t> keys_;
};

}  // namespace swarmanoid::python_scripts
