#include "python/module/device_values.h"

#include <stdexcept>
#include <utility>

#include "common/plugins/catalogue.h"

namespace swarmanoid::python
{
namespace
{

[[noreturn]] void RefuseCount(const std::string& type, std::size_t given, const std::string& stated)
{
  throw std::runtime_error("the sensor '" + type + "' gave " + std::to_string(given) + " numbers and states " + stated +
                           "; what its interface declares must have the same size at every tick");
}

}  // namespace

std::map<std::string, CCI_Sensor*> SensorsOf(const CCI_Robot& robot)
{
  std::map<std::string, CCI_Sensor*> sensors;
  for (const std::string& type : PluginCatalogue::Instance().Labels(PluginKind::kSensor))
    if (robot.HasSensor(type)) sensors[type] = robot.GetSensor(type);
  return sensors;
}

std::map<std::string, CCI_Actuator*> ActuatorsOf(const CCI_Robot& robot)
{
  std::map<std::string, CCI_Actuator*> actuators;
  for (const std::string& type : PluginCatalogue::Instance().Labels(PluginKind::kActuator))
    if (robot.HasActuator(type)) actuators[type] = robot.GetActuator(type);
  return actuators;
}

std::vector<std::string> NamesOf(const std::vector<CCI_Column>& columns)
{
  std::vector<std::string> names;
  for (const CCI_Column& column : columns) names.push_back(column.Title());
  return names;
}

SensorReader::SensorReader(std::string type, const CCI_Sensor& sensor)
    : type_(std::move(type)), sensor_(&sensor), columns_(NamesOf(sensor.Columns())), rows_(NamesOf(sensor.Rows()))
{
}

void SensorReader::ReadColumns(std::vector<double>& values) const
{
  values.clear();
  sensor_->ReadColumns(values);
  if (values.size() != columns_.size()) RefuseCount(type_, values.size(), std::to_string(columns_.size()) + " columns");
}

void SensorReader::ReadRows(std::vector<double>& values) const
{
  values.clear();
  sensor_->ReadRows(values);
  if (rows_.empty() ? !values.empty() : values.size() % rows_.size() != 0)
    RefuseCount(type_, values.size(), "rows of " + std::to_string(rows_.size()));
}

std::vector<std::string> SensorReader::RowIds() const
{
  std::vector<std::string> ids;
  sensor_->ReadRowIds(ids);
  return ids;
}

}  // namespace swarmanoid::python
