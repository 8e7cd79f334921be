// Devices are looked up once for each set of robots. Readings that a device keeps as one span of doubles are handed out
// where they are, others are copied. A command that was never written is a NaN with bits that no computation makes.
#include "common/control_interface/ci_batch_controller.h"

#include <algorithm>
#include <bit>

#include "common/math/finite.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kNotWrittenBits = 0x7ff8'6e6f'7420'7365;
constexpr double kNotWritten = std::bit_cast<double>(kNotWrittenBits);

bool IsWritten(double value) { return std::bit_cast<std::uint64_t>(value) != kNotWrittenBits; }

// Returns the only group of columns for programs, or nullptr if there are several or its numbers are not kept in place.
const CCI_ColumnGroup* GroupInPlace(const CCI_Columns& columns)
{
  const CCI_ColumnGroup* found = nullptr;
  for (const CCI_ColumnGroup& group : columns.readings)
  {
    if (!group.IsFor(CCI_Column::For::kPrograms)) continue;
    if (found != nullptr || !group.find_rows) return nullptr;
    found = &group;
  }
  return found;
}

// Returns the number of columns for programs, without making their names.
std::size_t CountOf(const std::vector<CCI_ColumnGroup>& groups, const CCI_Device& device)
{
  std::size_t count = 0;
  for (const CCI_ColumnGroup& group : groups)
    if (group.IsFor(CCI_Column::For::kPrograms)) count += group.CountOf(device) * group.columns.size();
  return count;
}

template <class Tables>
auto TableOf(Tables& tables, std::string_view type)
{
  return std::ranges::find_if(tables, [&](const auto& table) { return table.type == type; });
}

}  // namespace

void CCI_Batch::Replace(CCI_Controller& controller)
{
  controllers_.resize(next_);
  controllers_.push_back(&controller);
  next_ = controllers_.size();
  sensors_.clear();
  actuators_.clear();
}

void CCI_Batch::Begin()
{
  failed_ = 0;
  if (next_ < controllers_.size())
  {
    controllers_.resize(next_);
    sensors_.clear();
    actuators_.clear();
  }
  for (Sensors& sensors : sensors_) sensors.is_read = false;
  for (Actuators& actuators : actuators_) actuators.is_used = false;
}

void CCI_Batch::RefuseColumns(const char* what, const std::string& type, std::size_t first, std::size_t columns,
                              std::size_t k)
{
  failed_ = k;
  const std::string of = std::string("the ") + what + " '" + type + "' of the robot '";
  if (k == 0)
    throw CCI_DeviceError(of + Robot(0).GetId() + "' has no columns that exist at every tick; use Robot(k).Get" +
                          (what[0] == 's' ? "Sensor" : "Actuator"));
  throw CCI_DeviceError(of + Robot(k).GetId() + "' has " + std::to_string(columns) +
                        " columns, and that of the robot '" + Robot(0).GetId() + "' " + std::to_string(first) +
                        "; give each kind of robot a controller of its own");
}

// Sets the devices and columns of a table. `find`: a robot's device and the number of its columns.
template <class Table, class Find>
void CCI_Batch::Fill(Table& table, const char* what, const Find& find)
{
  for (std::size_t k = 0; k < Size(); ++k)
  {
    const auto [device, columns] = find(Robot(k));
    if (k == 0) table.columns = columns;
    if (columns != table.columns || columns == 0) RefuseColumns(what, table.type, table.columns, columns, k);
    table.devices.push_back(device);
  }
}

CCI_Batch::Sensors& CCI_Batch::SensorsOf(std::string_view type)
{
  if (const auto found = TableOf(sensors_, type); found != sensors_.end()) return *found;
  Sensors sensors{std::string(type)};
  Fill(sensors, "sensor",
       [&](CCI_Robot& robot)
       {
         const CCI_Sensor* const sensor = robot.GetSensor(sensors.type);
         return std::pair(sensor, CountOf(sensor->Declared().readings, *sensor));
       });
  if (Size() > 0) sensors.in_place = GroupInPlace(sensors.devices.front()->Declared());
  sensors.rows.resize(Size());
  return sensors_.emplace_back(std::move(sensors));
}

CCI_Batch::Actuators& CCI_Batch::ActuatorsOf(std::string_view type)
{
  if (const auto found = TableOf(actuators_, type); found != actuators_.end()) return *found;
  Actuators actuators{std::string(type)};
  Fill(actuators, "actuator",
       [&](CCI_Robot& robot)
       {
         CCI_Actuator* const actuator = robot.GetActuator(actuators.type);
         return std::pair(actuator, CountOf(actuator->Declared().settings, *actuator));
       });
  actuators.table.resize(Size() * actuators.columns);
  return actuators_.emplace_back(std::move(actuators));
}

CCI_Readings CCI_Batch::Readings(std::string_view sensor)
{
  Sensors& sensors = SensorsOf(sensor);
  if (!sensors.is_read) Read(sensors);
  return {sensors.rows, sensors.columns};
}

void CCI_Batch::Read(Sensors& sensors)
{
  if (sensors.in_place != nullptr)
  {
    const std::size_t found = sensors.in_place->find_rows(sensors.devices, sensors.columns, sensors.rows.data());
    if (found < Size()) RefuseReadings(sensors, found);
  }
  else
    CopyRows(sensors);
  sensors.is_read = true;
}

void CCI_Batch::CopyRows(Sensors& sensors)
{
  std::vector<double>& copies = sensors.copies;
  copies.clear();
  for (std::size_t k = 0; k < Size(); ++k)
  {
    sensors.devices[k]->ReadColumns(copies);
    if (copies.size() != (k + 1) * sensors.columns) RefuseReadings(sensors, k);
  }
  for (std::size_t k = 0; k < Size(); ++k) sensors.rows[k] = &copies[k * sensors.columns];
}

void CCI_Batch::RefuseReadings(const Sensors& sensors, std::size_t k)
{
  failed_ = k;
  throw CCI_DeviceError("the sensor '" + sensors.type + "' of the robot '" + Robot(k).GetId() +
                        "' has another number of readings than columns");
}

CCI_Commands CCI_Batch::Commands(std::string_view actuator)
{
  Actuators& actuators = ActuatorsOf(actuator);
  if (!actuators.is_used) std::ranges::fill(actuators.table, kNotWritten);
  actuators.is_used = true;
  return {actuators.table, actuators.columns};
}

void CCI_Batch::SetCommands()
{
  for (Actuators& actuators : actuators_)
  {
    if (!actuators.is_used) continue;
    actuators.is_used = false;
    const auto& set = actuators.devices.front()->Declared().set;
    const std::span<const double> table = actuators.table;
    if (AllFinite(table))
    {
      set(actuators.devices, table);
      continue;
    }
    for (std::size_t k = 0; k < Size(); ++k)
    {
      const std::span<const double> row = table.subspan(k * actuators.columns, actuators.columns);
      if (std::ranges::none_of(row, IsWritten)) continue;
      if (!AllFinite(row)) RefuseCommands(actuators, k, row);
      set(std::span(actuators.devices).subspan(k, 1), row);
    }
  }
}

void CCI_Batch::RefuseCommands(const Actuators& actuators, std::size_t k, std::span<const double> row)
{
  failed_ = k;
  std::size_t i = 0;
  while (AllFinite(row.subspan(i, 1))) ++i;
  const CCI_Column column = static_cast<const CCI_Actuator*>(actuators.devices[k])->Columns()[i];
  throw CCI_DeviceError("column " + std::to_string(i) + " ('" + column.Title() + "') of the actuator '" +
                        actuators.type +
                        (IsWritten(row[i]) ? "' is not a finite number" : "' was not set, but others of its row were"));
}

void CCI_BatchController::ControlStep()
{
  if (alone_ == nullptr) alone_ = std::make_unique<CCI_Batch>();
  alone_->Clear();
  alone_->Add(*this);
  alone_->Begin();
  ControlSteps(*alone_);
  alone_->SetCommands();
}

}  // namespace swarmanoid
