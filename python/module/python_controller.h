// Controllers written in Python, one object of a user's class for each robot. For prototypes, in one process.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>

#include "common/control_interface/ci_controller.h"
#include "python/module/device_values.h"

namespace swarmanoid::python
{

// The robot of a controller in Python: swarmanoid.Robot.
class PythonRobot
{
public:
  explicit PythonRobot(CCI_Robot& robot);

  const CCI_Robot& Robot() const { return robot_; }
  // Returns one number for each column (1-D), or one row for each reading (2-D) for a sensor without columns. Throws
  // KeyError with the types that exist.
  pybind11::object Read(const std::string& type) const;
  // The same of a sensor that has both. Throws KeyError for a sensor without rows.
  pybind11::object Rows(const std::string& type) const;
  std::vector<std::string> RowIds(const std::string& type) const;
  void Set(const std::string& type, const std::vector<double>& values);
  std::vector<std::string> ColumnsOfSensor(const std::string& type) const;
  std::vector<std::string> ColumnsOfRows(const std::string& type) const;
  std::vector<std::string> ColumnsOfActuator(const std::string& type) const;
  double Uniform(double low, double high) { return robot_.GetRandom().Uniform(low, high); }

private:
  const SensorReader& ReaderOf(const std::string& type) const;
  const SensorReader& RowReaderOf(const std::string& type) const;

  CCI_Robot& robot_;
  std::map<std::string, SensorReader> sensors_;
  struct Actuator
  {
    CCI_Actuator* device = nullptr;
    std::vector<std::string> columns{};
  };
  std::map<std::string, Actuator> actuators_;
};

// Makes `type`, a class of Python with control_step(robot), a controller of experiment files: <label …>.
void RegisterPythonController(const std::string& label, pybind11::object type);

// Returns a tree of a configuration: a dict of texts and of dicts, of lists where names are repeated.
pybind11::object ToPython(const TConfigurationTree& tree);

}  // namespace swarmanoid::python
