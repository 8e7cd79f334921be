#include "common/space/space.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#include "common/space/attributes.h"
#include "common/space/battery_slots.h"
#include "common/space/message_slots.h"
#include "common/space/state_checks.h"

namespace swarmanoid
{
namespace
{

template <class Space>
auto Components(Space& poses)
{
  return std::array{&poses.x, &poses.y, &poses.z, &poses.qx, &poses.qy, &poses.qz, &poses.qw};
}

}  // namespace

CSwarmanoidSpace::CSwarmanoidSpace(const Experiment& experiment)
    : experiment_(experiment), structure_(*this), fields_(experiment)
{
  const std::size_t count = experiment.entities.size();
  for (auto* component : Components(poses_)) component->resize(count);
  entities_.reserve(count);
  place_of_id_.resize(std::bit_ceil(2 * count + 1));
  const EngineChoices& choices = experiment.engine_choices;
  const std::vector<int> engines = choices.entities.empty() ? std::vector<int>() : StartEngines(experiment);
  std::size_t slots = count + EngineSlots::kCount * choices.entities.size();  // and those of presence
  for (const EntityConfiguration& configuration : experiment.entities)
    slots +=
        static_cast<std::size_t>(AttributeCount(configuration.kind) + FurtherMessageSlots(experiment, configuration)) +
        DepositSlots(experiment, configuration) + BatterySlotsOf(experiment, configuration);
  attributes_.reserve(slots);
  for (std::size_t i = 0; i < count; ++i)
  {
    const EntityConfiguration& configuration = experiment.entities[i];
    const auto index = static_cast<std::uint32_t>(i);
    const auto first_slot = static_cast<std::uint32_t>(attributes_.size());
    for (const AttributeSpec& spec : AttributesOf(configuration.kind))
    {
      const double initial = spec.name == "colour"      ? configuration.colour
                             : spec.name == "intensity" ? configuration.intensity
                             : spec.name == kChargingPower || spec.name == kChargingLimit
                                 ? configuration.tree.GetNumber(spec.name, spec.initial)
                                 : spec.initial;
      attributes_.resize(attributes_.size() + static_cast<std::size_t>(spec.count), initial);
    }
    const auto further = static_cast<std::size_t>(FurtherMessageSlots(experiment, configuration));
    attributes_.resize(attributes_.size() + further);
    const std::size_t rates = DepositSlots(experiment, configuration);
    if (rates > 0) fields_.AddDepositor(index, static_cast<std::uint32_t>(attributes_.size()));
    attributes_.resize(attributes_.size() + rates);
    std::vector<double> battery;
    if (const auto model = BatteryOf(experiment, configuration)) battery = FullBattery(*model);
    for (const double number : battery) attributes_.push_back(number);
    const bool changes_engine =
        engine_slots_.size() < choices.entities.size() && choices.entities[engine_slots_.size()] == index;
    attribute_values_.Add(configuration.kind, static_cast<std::uint32_t>(further), changes_engine,
                          static_cast<std::uint32_t>(rates + battery.size()));
    if (changes_engine)
    {
      engine_slots_.push_back(static_cast<std::uint32_t>(attributes_.size()));
      attributes_.resize(attributes_.size() + EngineSlots::kVelocity, engines[i]);
      attributes_.resize(attributes_.size() + EngineSlots::kCount - EngineSlots::kVelocity);
    }
    entities_.push_back(MakeEntity(memory_of_entities_, *this, index, configuration, first_slot));
    if (std::uint32_t& place = place_of_id_[PlaceOfId(configuration.id)]; place == 0) place = index + 1;
    if (configuration.movable) movable_.push_back(index);
    SetPose(i, configuration.pose);
  }
  first_presence_ = static_cast<std::uint32_t>(attributes_.size());
  for (const EntityConfiguration& configuration : experiment.entities)
    attributes_.push_back(configuration.waits ? 0 : 1);
  FindAbsent();
}

CSwarmanoidSpace::~CSwarmanoidSpace() = default;

std::size_t CSwarmanoidSpace::PlaceOfId(std::string_view id) const
{
  const std::size_t last = place_of_id_.size() - 1;
  std::size_t place = XXH3_64bits(id.data(), id.size()) & last;
  while (place_of_id_[place] != 0 && experiment_.entities[place_of_id_[place] - 1].id != id) place = (place + 1) & last;
  return place;
}

const CSwarmanoidSpaceEntity* CSwarmanoidSpace::FindEntity(std::string_view id) const
{
  const std::uint32_t found = place_of_id_[PlaceOfId(id)];
  return found == 0 ? nullptr : entities_[found - 1].get();
}

CSwarmanoidSpaceEntity* CSwarmanoidSpace::FindEntity(std::string_view id)
{
  const std::uint32_t found = place_of_id_[PlaceOfId(id)];
  return found == 0 ? nullptr : entities_[found - 1].get();
}

const FloorFields& CSwarmanoidSpace::Fields() const
{
  if (!fields_.AreKept())
    throw std::logic_error(
        "this process does not keep the floor fields: engines have none, and a device that reads them must not "
        "override "
        "Reach");
  return fields_;
}

Pose CSwarmanoidSpace::GetPose(std::size_t i) const
{
  return {{poses_.x[i], poses_.y[i], poses_.z[i]}, {poses_.qw[i], poses_.qx[i], poses_.qy[i], poses_.qz[i]}};
}

std::uint32_t CSwarmanoidSpace::FirstHandSlot(std::size_t i) const
{
  return entities_[i]->FirstSlot() + static_cast<std::uint32_t>(AttributeOffset(entities_[i]->GetKind(), "gripped"));
}

std::span<const double> CSwarmanoidSpace::Hands(std::size_t i) const
{
  const int grippers = DescriptionOf(entities_[i]->GetKind()).grippers;
  if (grippers == 0) return {};
  return attributes_.Part(FirstHandSlot(i), static_cast<std::size_t>(grippers));
}

std::uint32_t CSwarmanoidSpace::EngineBefore(std::uint32_t entity) const
{
  return static_cast<std::uint32_t>(
      attributes_[engine_slots_[experiment_.engine_choices.PlaceOf(entity)] + EngineSlots::kBefore]);
}

int CSwarmanoidSpace::EngineOf(std::uint32_t entity, std::span<const int> engines) const
{
  const std::size_t k = experiment_.engine_choices.PlaceOf(entity);
  return k == engine_slots_.size() ? engines[entity]
                                   : static_cast<int>(attributes_[engine_slots_[k] + EngineSlots::kEngine]);
}

void CSwarmanoidSpace::SetPose(std::size_t i, const Pose& pose)
{
  ++revision_;
  poses_.x[i] = pose.position.x();
  poses_.y[i] = pose.position.y();
  poses_.z[i] = pose.position.z();
  poses_.qx[i] = pose.orientation.x();
  poses_.qy[i] = pose.orientation.y();
  poses_.qz[i] = pose.orientation.z();
  poses_.qw[i] = pose.orientation.w();
}

void CSwarmanoidSpace::SetPoses(std::span<const std::uint32_t> entities, std::span<const double> poses)
{
  const std::size_t count = entities.size();
  if (count == 0) return;
  ++revision_;
  // The robots of a large experiment are usually one contiguous run, so their poses are copied as a block.
  const bool contiguous = entities.back() - entities.front() + 1 == count;
  const double* source = poses.data();
  for (auto* component : Components(poses_))
  {
    double* target = component->data();
    if (contiguous)
      std::copy_n(source, count, target + entities.front());
    else
      for (std::size_t k = 0; k < count; ++k) target[entities[k]] = source[k];
    source += count;
  }
}

void CSwarmanoidSpace::SetAttribute(std::uint32_t slot, double value)
{
  ++attribute_revision_;
  attributes_.Set(slot, value);
  if (attribute_values_[slot] == AttributeValue::kEntity) structure_.Follow(EntityOfSlot(*this, slot));
  if (slot < first_presence_) return;
  ++revision_;
  const std::uint32_t entity = slot - first_presence_;
  const auto place = std::lower_bound(absent_.begin(), absent_.end(), entity);
  const bool was_absent = place != absent_.end() && *place == entity;
  if (value == 0 && !was_absent) absent_.insert(place, entity);
  if (value != 0 && was_absent) absent_.erase(place);
}

void CSwarmanoidSpace::SetAttributes(const AttributeChanges& changes)
{
  if (changes.slots.empty()) return;
  ++attribute_revision_;
  bool presence = false;
  bool holds = false;
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    attributes_.Set(changes.slots[k], changes.values[k]);
    presence |= changes.slots[k] >= first_presence_;
    holds |= attribute_values_[changes.slots[k]] == AttributeValue::kEntity;
  }
  if (presence) FindAbsent();
  if (!holds) return;
  for (const std::uint32_t slot : changes.slots)
    if (attribute_values_[slot] == AttributeValue::kEntity) structure_.Follow(EntityOfSlot(*this, slot));
}

void CSwarmanoidSpace::FindAbsent()
{
  ++revision_;
  absent_.clear();
  for (std::uint32_t i = 0; i < Size(); ++i)
    if (!IsPresent(i)) absent_.push_back(i);
}

void CSwarmanoidSpace::SwapDrawing(Drawing& drawing)
{
  if (drawing == drawing_) return;
  std::swap(drawing_, drawing);
  ++drawing_revision_;
}

void CSwarmanoidSpace::SetDrawing(const Drawing& drawing)
{
  if (drawing == drawing_) return;
  drawing_ = drawing;
  ++drawing_revision_;
}

void CSwarmanoidSpace::WritePoses(std::vector<double>& poses) const
{
  const std::size_t count = movable_.size();
  poses.resize(7 * count);
  if (count == 0) return;
  const bool contiguous = movable_.back() - movable_.front() + 1 == count;
  double* target = poses.data();
  for (const auto* component : Components(poses_))
  {
    const double* source = component->data();
    if (contiguous)
      std::copy_n(source + movable_.front(), count, target);
    else
      for (std::size_t k = 0; k < count; ++k) target[k] = source[movable_[k]];
    target += count;
  }
}

}  // namespace swarmanoid
