#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"

namespace swarmanoid
{
namespace
{

constexpr double kMostFieldCells = 1 << 24;  // of one field
constexpr double kMostCellsOfFields = 1 << 26;
constexpr const char* kFieldOfArena = "<field of the arena>";  // lost (Diagnostics::Lose) if a field is wrong

// Returns the number of cells along one side of the arena; an incomplete last cell counts.
std::size_t CellsAlong(double length_m, double cell_m)
{
  constexpr double kSlack = 1e-9;
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length_m / cell_m - kSlack)));
}

// Explicit diffusion in two dimensions is stable up to this constant (Press et al., Numerical Recipes, 20.2).
void CheckStability(const FloorFieldConfiguration& field, const ElementReader& reader, Reading& reading)
{
  const double step_s = reading.experiment.TickSeconds() * field.period;
  const double most = field.cell_m * field.cell_m / (4 * step_s);
  if (field.diffusion_m2_per_s <= most) return;
  reading.diagnostics.Add(
      reader.Place("diffusion"),
      fmt::format("the diffusion of <floor_field> {} is {:g} m²/s; with cells of {:g} m and steps of {:g} s it must be "
                  "at most cell² / (4 · step) = {:g} m²/s; lower it{}, or take larger cells",
                  Quoted(field.id), field.diffusion_m2_per_s, field.cell_m, step_s, most,
                  field.period > 1 ? " or the period" : ""));
}

}  // namespace

void ReadFloorField(const TConfigurationTree& tree, const ElementSpec& spec, Reading& reading)
{
  const ElementReader reader(tree, spec, reading.diagnostics);
  FloorFieldConfiguration field;
  field.location = tree.Location();
  field.id = reader.Text("id");
  field.cell_m = reader.Number("cell");
  field.evaporation_per_s = reader.Number("evaporation");
  field.diffusion_m2_per_s = reader.Number("diffusion");
  field.period = static_cast<std::uint32_t>(std::max(1LL, reader.Integer("period")));
  field.least = reader.Number("least");
  field.colour = reader.Colour("colour");
  field.full = reader.Number("full");
  if (reader.IsGiven("id")) CheckId(field.id, reader.Place("id"), reading.diagnostics);
  auto& fields = reading.experiment.floor_fields;
  const auto same = std::ranges::find(fields, field.id, &FloorFieldConfiguration::id);
  if (same != fields.end() && !field.id.empty())
    reading.diagnostics.Add(reader.Place("id"), fmt::format("two <floor_field> have the id {}; the first is in line {}",
                                                            Quoted(field.id), same->location.line));
  const Vector3& size = reading.experiment.arena_size;
  if (size.isZero() || field.cell_m <= 0) return reading.diagnostics.Lose(kFieldOfArena);  // reported already
  const double cells = std::ceil(size.x() / field.cell_m) * std::ceil(size.y() / field.cell_m);
  double all = cells;
  for (const FloorFieldConfiguration& other : fields) all += static_cast<double>(other.Cells());
  if (cells > kMostFieldCells || all > kMostCellsOfFields)
  {
    reading.diagnostics.Add(
        reader.Place("cell"),
        fmt::format("<floor_field> {} has {:.0f} cells of {:g} m; a field may have {:.0f}, and all together {:.0f}; "
                    "take larger cells",
                    Quoted(field.id), cells, field.cell_m, kMostFieldCells, kMostCellsOfFields));
    return reading.diagnostics.Lose(kFieldOfArena);
  }
  field.columns = CellsAlong(size.x(), field.cell_m);
  field.rows = CellsAlong(size.y(), field.cell_m);
  CheckStability(field, reader, reading);
  fields.push_back(std::move(field));
}

void CheckFloorFieldDevices(Reading& reading)
{
  if (!reading.experiment.floor_fields.empty()) return;
  const auto check = [&](const char* what, const DeviceConfiguration& device)
  {
    if (device.type != "floor_field" || reading.diagnostics.IsLost(kFieldOfArena)) return;
    reading.diagnostics.Add(device.tree.Location(),
                            fmt::format("the {} <floor_field> needs a field, but the arena has none; add <floor_field "
                                        "id=\"trail\" …/> to <arena>",
                                        what));
  };
  for (const ControllerConfiguration& controller : reading.experiment.controllers)
  {
    for (const DeviceConfiguration& device : controller.actuators) check("actuator", device);
    for (const DeviceConfiguration& device : controller.sensors) check("sensor", device);
  }
}

}  // namespace swarmanoid
