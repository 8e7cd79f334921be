#include "common/space/drawn_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/space/attributes.h"
#include "common/space/battery_slots.h"
#include "common/space/drawn_fields.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr Ink kWindInk{0x2060c0, 1, 3};
constexpr Ink kBoltInk{0x303030, 1, 1};
constexpr std::uint32_t kBarGreen = 0x20a040, kBarYellow = 0xe0b000, kBarRed = 0xd03020, kBarEmpty = 0x404040;
constexpr double kBarWidth = 4;          // pixels
constexpr double kAboveAreas_m = 0.013;  // renderers lift areas of the floor by less (visualiser/scene/scene.cpp)
constexpr double kGustsInLength = 0.4;   // two deviations of low gusts, as a part of the wind at 6.1 m

std::uint32_t BarColour(double share) { return share > 0.5 ? kBarGreen : share > 0.2 ? kBarYellow : kBarRed; }

}  // namespace

DrawnState::DrawnState(const CSwarmanoidSpace& space) : space_(space), wind_(space.GetExperiment())
{
  const Experiment& experiment = space.GetExperiment();
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    const Vector3& size = entity.GetSize();
    if (const int power = AttributeOffset(entity.GetKind(), kChargingPower); power >= 0)
      stations_.push_back({e, entity.FirstSlot() + static_cast<std::uint32_t>(power),
                           size.y() == 0 ? size.x() : std::min(size.x(), size.y()) / 2});
    if (kind.role != EntityRole::kRobot) continue;
    const std::optional<BatteryModel> model = BatteryOf(experiment, experiment.entities[e]);
    if (!model) continue;
    const double width = kind.form == BodyForm::kCylinder ? size.x() : size.x() / 2;
    batteries_.push_back({e, BatteryView::Of(space, e)->Slot(BatterySlots::kCharge), model->capacity_j,
                          kind.label_height_m > 0 ? kind.label_height_m : size.z() + 0.03,
                          std::clamp(width, 0.02, 0.3)});
  }
  if (batteries_.size() > kMostBars) batteries_.clear();
}

void DrawnState::Draw(Drawing& drawing) const
{
  DrawFields(space_, drawing);
  DrawStations(drawing);
  DrawBatteries(drawing);
  DrawWind(drawing);
}

void DrawnState::DrawWind(Drawing& drawing) const
{
  if (!wind_.IsDeclared()) return;
  const Experiment& experiment = space_.GetExperiment();
  const Vector3 middle = experiment.arena_size / 2;
  const Vector3 air = wind_.At(middle, space_.GetTime());
  const WindConfiguration& declared = *experiment.wind;
  const double fastest = std::sqrt(declared.velocity_m_s.squaredNorm()) + kGustsInLength * declared.gusts_m_s;
  const double room = 0.2 * std::min(experiment.arena_size.x(), experiment.arena_size.y());
  const Vector3 half = fastest > 0 ? Vector3(air * (room / fastest / 2)) : Vector3(Vector3::Zero());
  const Vector3 place(0.7 * room, 0.7 * room, kAboveAreas_m + std::abs(half.z()));
  drawing.Arrow(place - half, place + half, kWindInk);
  drawing.Text(place - Vector3(0, 0.4 * room, 0), fmt::format("wind {:.2f} m/s", std::sqrt(air.squaredNorm())),
               kWindInk);
}

void DrawnState::DrawStations(Drawing& drawing) const
{
  for (const Station& station : stations_)
  {
    if (space_.Attributes()[station.power_slot] <= 0) continue;
    drawing.InFrameOf(station.entity);
    const double size = 0.6 * station.radius_m;
    for (const double side : {1.0, -1.0})
    {
      const auto corner = [&](double x, double y) { return Vector3(side * x * size, side * y * size, kAboveAreas_m); };
      drawing.Polygon(std::array{corner(0.2, 1), corner(-0.45, -0.15), corner(0.15, -0.15)}, kBoltInk);
    }
  }
  drawing.InSpace();
}

void DrawnState::DrawBatteries(Drawing& drawing) const
{
  for (const Battery& battery : batteries_)
  {
    if (!space_.IsPresent(battery.robot)) continue;
    const double share = std::clamp(space_.Attributes()[battery.charge_slot] / battery.capacity_j, 0.0, 1.0);
    const Vector3 middle = space_.GetPose(battery.robot).position + Vector3(0, 0, battery.height_m);
    const auto at = [&](double part) { return Vector3(middle + Vector3((2 * part - 1) * battery.half_width_m, 0, 0)); };
    if (share > 0) drawing.Segment(at(0), at(share), {BarColour(share), 1, kBarWidth});
    if (share < 1) drawing.Segment(at(share), at(1), {kBarEmpty, 1, kBarWidth});
  }
}

}  // namespace swarmanoid
