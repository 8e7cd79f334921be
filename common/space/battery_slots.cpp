#include "common/space/battery_slots.h"

#include "common/space/attributes.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"

namespace swarmanoid
{

std::size_t BatterySlotsOf(const Experiment& experiment, const EntityConfiguration& entity)
{
  return BatteryOf(experiment, entity) ? BatterySlots::kCount : 0;
}

std::vector<double> FullBattery(const BatteryModel& model)
{
  std::vector<double> slots(BatterySlots::kCount, 0.0);
  slots[BatterySlots::kCharge] = model.start * model.capacity_j;
  slots[BatterySlots::kOff] = model.stops && model.start == 0 ? 1 : 0;
  return slots;
}

std::optional<BatteryView> BatteryView::Of(const CSwarmanoidSpace& space, std::uint32_t entity)
{
  const Experiment& experiment = space.GetExperiment();
  const EntityConfiguration& configuration = experiment.entities[entity];
  const std::optional<BatteryModel> model = BatteryOf(experiment, configuration);
  if (!model) return std::nullopt;
  const auto before = static_cast<std::size_t>(AttributeCount(configuration.kind)) +
                      static_cast<std::size_t>(FurtherMessageSlots(experiment, configuration)) +
                      DepositSlots(experiment, configuration);
  return BatteryView(space, *model, space.GetEntity(entity).FirstSlot() + static_cast<std::uint32_t>(before));
}

double BatteryView::Number(std::uint32_t part) const { return space_->Attributes()[Slot(part)]; }

}  // namespace swarmanoid
