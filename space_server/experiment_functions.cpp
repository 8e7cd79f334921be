#include "space_server/experiment_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/configuration/output_file.h"
#include "common/configuration/wording.h"
#include "common/space/attributes.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "space_server/space_changes.h"
#include "space_server/space_server.h"

namespace swarmanoid
{
namespace
{

const CSwarmanoidSpaceEntity& FindOrThrow(const CSwarmanoidSpace& space, std::string_view id)
{
  if (const CSwarmanoidSpaceEntity* entity = space.FindEntity(id)) return *entity;
  throw std::invalid_argument("there is no entity '" + std::string(id) + "'");
}

}  // namespace

template <>
PluginRegistry<CExperimentFunctions>& PluginRegistry<CExperimentFunctions>::Instance()
{
  static PluginRegistry registry(PluginKind::kExperimentFunctions);
  return registry;
}

template class PluginRegistry<CExperimentFunctions>;

std::string SpaceEditor::MakeOutputFile(const TConfigurationTree& tree, const std::string& parameter) const
{
  try
  {
    return OutputFiles(output_folder_).Claim(tree.GetText(parameter));
  }
  catch (const OutputFileError& error)
  {
    throw ConfigurationError(tree.ValueLocation(parameter), parameter + ": " + error.what());
  }
}

const CSwarmanoidSpace& SpaceEditor::GetSpace() const { return server_.Space(); }

SpaceQuery& SpaceEditor::GetQuery()
{
  if (query_ == nullptr) query_ = std::make_unique<SpaceQuery>(server_.Space());
  return *query_;
}

const StructuralTree& SpaceEditor::GetStructure() const { return server_.Space().Structure(); }

void SpaceEditor::MoveCompound(std::string_view id, const Pose& pose, EOccupied occupied)
{
  const CSwarmanoidSpace& space = server_.Space();
  const CSwarmanoidSpaceEntity& entity = FindToMove(space, id);
  CheckPose(space, entity.GetIndex(), pose);
  const std::vector<MoveRequest> moves = CompoundAt(space, entity, pose);
  if (occupied == EOccupied::kRefuse) RequireFree(space, moves);
  server_.Move(moves);
}

void SpaceEditor::MoveEntity(std::string_view id, const Pose& pose, EOccupied occupied)
{
  const CSwarmanoidSpace& space = server_.Space();
  const CSwarmanoidSpaceEntity& entity = FindToMove(space, id);
  CheckPose(space, entity.GetIndex(), pose);
  if (occupied == EOccupied::kRefuse) RequireFree(space, entity, pose);
  server_.Move({entity.GetIndex(), pose});
}

bool SpaceEditor::IsFree(std::string_view id, const Pose& pose) const
{
  const CSwarmanoidSpace& space = server_.Space();
  return FindInTheWay(space, FindToAdd(space, id), pose) == nullptr;
}

std::string SpaceEditor::AddEntity(std::string_view id, const Pose& pose)
{
  const CSwarmanoidSpace& space = server_.Space();
  const CSwarmanoidSpaceEntity& added = FindToAdd(space, id);
  CheckPose(space, added.GetIndex(), pose);
  RequireFree(space, added, pose);
  server_.Move({added.GetIndex(), pose});
  return added.GetId();
}

void SpaceEditor::BeginAgain(std::uint64_t first_tick, std::uint32_t variation)
{
  server_.BeginAgain(first_tick, variation);
}

void SpaceEditor::Deposit(std::string_view field, double x, double y, double amount)
{
  const FloorField& on = server_.Space().Fields().Field(field);
  const std::size_t cell = std::isfinite(x) && std::isfinite(y) ? on.CellAt(x, y) : on.Cells();
  if (cell == on.Cells())
    throw std::invalid_argument(fmt::format("the point {:g}, {:g} is outside the floor field '{}'", x, y, field));
  if (!std::isfinite(amount))
    throw std::invalid_argument(
        fmt::format("an amount of {:g} on the floor field '{}'; it must be finite", amount, field));
  const double edge = on.GetConfiguration().cell_m;
  const double value = on.ValueOf(cell) + amount / (edge * edge);
  SetFieldCell(field, cell, std::clamp(value, 0.0, static_cast<double>(FloorField::kMost)));
}

void SpaceEditor::SetFieldCell(std::string_view field, std::size_t cell, double value)
{
  const FloorFields& fields = server_.Space().Fields();
  const std::size_t number = fields.NumberOf(field);
  if (cell >= fields[number].Cells())
    throw std::invalid_argument(
        fmt::format("the floor field '{}' has {} cells; there is no cell {}", field, fields[number].Cells(), cell));
  if (!(value >= 0 && value <= FloorField::kMost))
    throw std::invalid_argument(fmt::format("the value {:g} for the floor field '{}'; it must be from 0 to {:g}", value,
                                            field, FloorField::kMost));
  server_.SetFieldCell(fields.FirstCell(number) + static_cast<std::uint32_t>(cell), static_cast<float>(value));
}

void SpaceEditor::SetCharge(std::string_view id, double charge_j)
{
  const CSwarmanoidSpaceEntity& entity = FindOrThrow(server_.Space(), id);
  const auto battery = BatteryView::Of(server_.Space(), entity.GetIndex());
  if (!battery)
    throw std::invalid_argument(
        fmt::format("'{}' has no battery that could be charged; give its controller the sensor <battery> with the "
                    "implementation {}",
                    id, kEnergyBattery));
  const double most_j = battery->Model().capacity_j;
  if (!(charge_j >= 0 && charge_j <= most_j))
    throw std::invalid_argument(
        fmt::format("a charge of {:g} J for '{}'; it must be from 0 to the capacity, {:g} J", charge_j, id, most_j));
  server_.SetAttribute(battery->Slot(BatterySlots::kCharge), charge_j);
}

void SpaceEditor::RemoveEntity(std::string_view id) { server_.Move(Removal(FindToRemove(server_.Space(), id))); }

void SpaceEditor::SetAttribute(std::string_view id, std::string_view attribute, double value, int element)
{
  const CSwarmanoidSpaceEntity& entity = FindOrThrow(server_.Space(), id);
  const AttributeSpec* spec = FindAttribute(entity.GetKind(), attribute);
  if (spec == nullptr)
  {
    std::vector<std::string> names;
    for (const AttributeSpec& one : AttributesOf(entity.GetKind())) names.emplace_back(one.name);
    throw std::invalid_argument(fmt::format("entity '{}' has no attribute {}; it has: {}{}", id, Quoted(attribute),
                                            Listed(names), DidYouMean(attribute, names)));
  }
  const int count =
      spec->count +
      (attribute == "message" ? FurtherMessageSlots(server_.Space().GetExperiment(), entity.GetConfiguration()) : 0);
  if (element < 0 || element >= count)
    throw std::invalid_argument(
        fmt::format("the attribute '{}' of '{}' has {} element{}, numbered from 0; there is no "
                    "element {}",
                    attribute, id, count, count == 1 ? "" : "s", element));
  server_.SetAttribute(entity.SlotOf(attribute, element), value);
}

}  // namespace swarmanoid
