#include "common/space/floor_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kDevice = "floor_field";

const DeviceConfiguration* ActuatorOf(const Experiment& experiment, const EntityConfiguration& entity)
{
  const ControllerConfiguration* controller =
      entity.controller.empty() ? nullptr : experiment.FindController(entity.controller);
  if (controller == nullptr) return nullptr;
  const auto found = std::ranges::find(controller->actuators, kDevice, &DeviceConfiguration::type);
  return found == controller->actuators.end() ? nullptr : &*found;
}

}  // namespace

std::size_t DepositSlots(const Experiment& experiment, const EntityConfiguration& entity)
{
  if (experiment.floor_fields.empty() || ActuatorOf(experiment, entity) == nullptr) return 0;
  return experiment.floor_fields.size();
}

std::size_t FloorFieldCells(const Experiment& experiment)
{
  std::size_t cells = 0;
  for (const FloorFieldConfiguration& field : experiment.floor_fields) cells += field.Cells();
  return cells;
}

FloorFields::FloorFields(const Experiment& experiment) : experiment_(experiment)
{
  fields_.reserve(experiment.floor_fields.size());
  std::uint32_t cells = 0;
  for (const FloorFieldConfiguration& field : experiment.floor_fields)
  {
    fields_.emplace_back(field, experiment.TickSeconds() * field.period);
    first_cells_.push_back(cells);
    cells += static_cast<std::uint32_t>(field.Cells());
  }
  first_cells_.push_back(cells);
}

void FloorFields::AddDepositor(std::uint32_t entity, std::uint32_t slot)
{
  const DeviceConfiguration* actuator = ActuatorOf(experiment_, experiment_.entities[entity]);
  const Vector2 point = actuator->tree.GetVector2("point", Vector2::Zero());
  depositors_.push_back({entity, slot, {point.x(), point.y(), 0}});
}

std::size_t FloorFields::NumberOf(std::string_view id) const
{
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < fields_.size(); ++k)
  {
    if (fields_[k].GetConfiguration().id == id) return k;
    ids.push_back(fields_[k].GetConfiguration().id);
  }
  throw std::invalid_argument(fmt::format("there is no floor field {}; there {}{}", Quoted(id),
                                          ids.empty() ? "is none" : "are: " + Listed(ids), DidYouMean(id, ids)));
}

std::uint32_t FloorFields::RateSlotOf(std::uint32_t entity) const
{
  return std::ranges::lower_bound(depositors_, entity, {}, &Depositor::entity)->slot;
}

std::size_t FloorFields::FieldOf(std::uint32_t cell) const
{
  return static_cast<std::size_t>(std::ranges::upper_bound(first_cells_, cell) - first_cells_.begin()) - 1;
}

float FloorFields::ValueOf(std::uint32_t cell) const
{
  const std::size_t field = FieldOf(cell);
  return fields_[field].ValueOf(cell - first_cells_[field]);
}

void FloorFields::Advance(const CSwarmanoidSpace& space)
{
  if (fields_.empty() || !are_kept_) return;
  ++revision_;
  for (const Depositor& depositor : depositors_)
    for (std::size_t k = 0; k < fields_.size(); ++k)
    {
      const double rate = space.Attributes()[depositor.slot + static_cast<std::uint32_t>(k)];
      if (rate == 0 || !space.IsPresent(depositor.entity)) continue;
      const Vector3 at = space.GetPose(depositor.entity).Apply(depositor.point);
      fields_[k].Add(at.x(), at.y(), rate * space.GetTickSeconds());
    }
  for (FloorField& field : fields_)
    if ((space.GetTick() + 1) % field.GetConfiguration().period == 0) field.Step();
}

void FloorFields::Set(std::uint32_t cell, float value)
{
  ++revision_;
  const std::size_t field = FieldOf(cell);
  fields_[field].Set(cell - first_cells_[field], value);
}

void FloorFields::SetCells(const FieldCells& cells)
{
  if (!are_kept_) return;
  const float* value = cells.values.data();
  for (std::size_t k = 0; k + 1 < cells.runs.size(); k += 2)
    for (std::uint32_t cell = cells.runs[k]; cell < cells.runs[k] + cells.runs[k + 1]; ++cell) Set(cell, *value++);
}

void FloorFields::Load(const FieldCells& cells)
{
  if (fields_.empty() || !are_kept_) return;
  ++revision_;
  for (FloorField& field : fields_) field.Clear();
  SetCells(cells);
}

void FloorFields::WriteCells(FieldCells& cells) const
{
  cells.runs.clear();
  cells.values.clear();
  VisitRuns(
      [&](std::size_t cell, std::span<const float> run)
      {
        cells.runs.push_back(static_cast<std::uint32_t>(cell));
        cells.runs.push_back(static_cast<std::uint32_t>(run.size()));
        cells.values.insert(cells.values.end(), run.begin(), run.end());
      });
}

void AddCell(FieldCells& cells, std::uint32_t cell, float value)
{
  const std::size_t numbers = cells.runs.size();
  if (numbers > 0 && cells.runs[numbers - 2] + cells.runs[numbers - 1] == cell)
    ++cells.runs[numbers - 1];
  else
    cells.runs.insert(cells.runs.end(), {cell, 1});
  cells.values.push_back(value);
}

std::string MistakeIn(const FieldCells& cells, std::size_t all)
{
  if (cells.runs.size() % 2 != 0) return "a run of cells has no length";
  std::uint64_t end = 0, count = 0;
  for (std::size_t k = 0; k < cells.runs.size(); k += 2)
  {
    if (cells.runs[k] < end || cells.runs[k + 1] == 0) return fmt::format("cell {} does not ascend", cells.runs[k]);
    end = std::uint64_t{cells.runs[k]} + cells.runs[k + 1];
    count += cells.runs[k + 1];
  }
  if (end > all) return fmt::format("there is no cell {}; the floor fields have {}", end - 1, all);
  if (count != cells.values.size()) return fmt::format("there are {} values for {} cells", cells.values.size(), count);
  for (const float value : cells.values)
    if (!(value >= 0 && value <= FloorField::kMost)) return fmt::format("the value {:g} is not from 0 to 1e30", value);
  return {};
}

}  // namespace swarmanoid
