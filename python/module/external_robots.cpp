// Programs in Python steer many robots faster by arrays than by a call for each robot. So the controllers of one
// <external_controller> share an array for each device, with a row for each robot: Read() fills the arrays of sensors
// before the program runs, and ControlSteps() copies the robots' rows to their actuators. A controller joins its group
// in Init, in the order of the space, and its row never changes.
#include "python/module/external_robots.h"

#include <algorithm>
#include <stdexcept>

namespace swarmanoid::python
{
namespace
{

ExternalRobots*& Current()
{
  static thread_local ExternalRobots* current = nullptr;
  return current;
}

// Makes room for one robot more in the array of a device of a group.
void WithRow(std::map<std::string, DeviceArray>& arrays, const std::string& type,
             const std::vector<std::string>& columns)
{
  DeviceArray& array = arrays[type];
  if (array.columns.empty()) array.columns = columns;
  if (array.columns.size() != columns.size())
    throw std::invalid_argument("the robots of one <external_controller> have devices of different sizes: '" + type +
                                "' has " + std::to_string(array.columns.size()) + " values for some and " +
                                std::to_string(columns.size()) + " for others; give each kind a controller of its own");
  array.values.resize(array.values.size() + columns.size(), 0);
}

}  // namespace

ExternalRobots::Open::Open(ExternalRobots& robots) { Current() = &robots; }
ExternalRobots::Open::~Open() { Current() = nullptr; }

ExternalRobots::ExternalRobots(const Experiment& experiment)
{
  for (const EntityConfiguration& entity : experiment.entities) controller_of_[entity.id] = entity.controller;
}

ExternalGroup& ExternalRobots::GroupOf(const std::string& robot) { return groups_[controller_of_.at(robot)]; }

std::vector<std::string> ExternalGroup::Ids() const
{
  std::vector<std::string> ids;
  for (const ExternalController* robot : robots_) ids.push_back(robot->GetRobot()->GetId());
  return ids;
}

std::vector<double> ExternalGroup::Rows(std::size_t robot, const std::string& type) const
{
  std::vector<double> rows;
  robots_.at(robot)->rows_.at(type).ReadRows(rows);
  return rows;
}

std::vector<std::string> ExternalGroup::RowIds(std::size_t robot, const std::string& type) const
{
  return robots_.at(robot)->rows_.at(type).RowIds();
}

void ExternalGroup::Read()
{
  batch_.Begin();
  for (auto& [type, array] : sensors_)
  {
    const CCI_Readings readings = batch_.Readings(type);
    double* next = array.values.data();
    for (std::size_t k = 0; k < batch_.Size(); ++k) next = std::ranges::copy(readings[k], next).out;
  }
}

ExternalController::ExternalController()
    : robots_(Current() != nullptr
                  ? *Current()
                  : throw std::runtime_error("an <external_controller> is steered by a program in Python: run the "
                                             "experiment from one (swarmanoid.Simulation)"))
{
}

int ExternalController::Init(const TConfigurationTree)
{
  const CCI_Robot& robot = *GetRobot();
  group_ = &robots_.GroupOf(robot.GetId());
  place_ = group_->robots_.size();
  group_->robots_.push_back(this);
  group_->batch_.Add(*this);
  for (const auto& [type, sensor] : SensorsOf(robot))
  {
    const SensorReader reader(type, *sensor);
    if (!reader.Columns().empty()) WithRow(group_->sensors_, type, reader.Columns());
    if (!reader.Rows().empty())
    {
      group_->row_sensors_[type] = reader.Rows();
      rows_[type] = reader;
    }
  }
  for (const auto& [type, actuator] : ActuatorsOf(robot))
    if (const std::vector<std::string> columns = NamesOf(actuator->Columns()); !columns.empty())
      WithRow(group_->actuators_, type, columns);
  return RETURN_OK;
}

void ExternalController::ControlSteps(CCI_Batch& robots)
{
  for (const auto& [type, array] : group_->actuators_)
  {
    const CCI_Commands commands = robots.Commands(type);
    const std::size_t width = commands.Columns();
    for (std::size_t k = 0; k < robots.Size(); ++k)
      std::copy_n(array.values.data() + robots.Of<ExternalController>(k).place_ * width, width, commands[k].data());
  }
}

}  // namespace swarmanoid::python
