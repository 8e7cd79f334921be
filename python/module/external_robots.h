// The controller <external_controller>: robots whose sensors are read and whose actuators are set from outside, as
// arrays over all robots of one entry of <controllers>. Used by the Python module, in one process.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/control_interface/ci_batch_controller.h"
#include "common/experiment/experiment.h"
#include "python/module/device_values.h"

namespace swarmanoid::python
{

class ExternalController;

// A device of all robots of a group: `width` numbers a robot, row by row.
struct DeviceArray
{
  std::vector<std::string> columns;
  std::vector<double> values;
};

// The robots of one <external_controller>, in the order of the space.
class ExternalGroup
{
public:
  std::size_t Size() const { return robots_.size(); }
  const std::vector<ExternalController*>& Robots() const { return robots_; }
  std::vector<std::string> Ids() const;

  // Returns the devices that have columns, by type. The arrays keep their addresses.
  std::map<std::string, DeviceArray>& Sensors() { return sensors_; }
  std::map<std::string, DeviceArray>& Actuators() { return actuators_; }
  // Returns the types of sensors whose count of readings differs between ticks, with the names of their columns.
  const std::map<std::string, std::vector<std::string>>& RowSensors() const { return row_sensors_; }
  // The rows of one robot, row by row, and the ids of the entities that they are about. Throws std::out_of_range for a
  // type that is no such sensor.
  std::vector<double> Rows(std::size_t robot, const std::string& type) const;
  std::vector<std::string> RowIds(std::size_t robot, const std::string& type) const;

  // Copies the readings of the sensors into the arrays.
  void Read();

private:
  friend class ExternalController;

  std::vector<ExternalController*> robots_;
  CCI_Batch batch_;  // all of them, for Read
  std::map<std::string, DeviceArray> sensors_, actuators_;
  std::map<std::string, std::vector<std::string>> row_sensors_;
};

// The groups of one simulation, by the id of their controller. While one is Open, controllers that are made join it.
class ExternalRobots
{
public:
  explicit ExternalRobots(const Experiment& experiment);

  std::map<std::string, ExternalGroup>& Groups() { return groups_; }
  // Returns the group of a robot, by its id.
  ExternalGroup& GroupOf(const std::string& robot);
  void Read()
  {
    for (auto& [id, group] : groups_) group.Read();
  }

  class Open
  {
  public:
    explicit Open(ExternalRobots& robots);
    ~Open();
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
  };

private:
  std::unordered_map<std::string, std::string> controller_of_;  // by id of the robot
  std::map<std::string, ExternalGroup> groups_;
};

class ExternalController : public CCI_BatchController
{
public:
  ExternalController();
  int Init(const TConfigurationTree t_tree) override;
  void ControlSteps(CCI_Batch& robots) override;

private:
  friend class ExternalGroup;

  ExternalRobots& robots_;
  ExternalGroup* group_ = nullptr;
  std::size_t place_ = 0;  // in the group
  std::map<std::string, SensorReader> rows_;
};

}  // namespace swarmanoid::python
