#include "common/space/state_checks.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include "common/math/finite.h"
#include "common/space/battery_slots.h"
#include "common/space/message_slots.h"
#include "common/space/space.h"
#include "common/threads/worker_pool.h"

namespace swarmanoid
{
namespace
{

constexpr std::array<const char*, 7> kComponents{"x", "y", "z", "qx", "qy", "qz", "qw"};

[[noreturn]] void Refuse(const std::string& text) { throw StateError(text); }

std::string NameOf(const CSwarmanoidSpace& space, std::uint32_t entity)
{
  const CSwarmanoidSpaceEntity& it = space.GetEntity(entity);
  return fmt::format("the {} '{}'", TagName(it.GetKind()), it.GetId());
}

// Returns 1 if a value is outside the range, or NaN.
std::uint64_t IsOutside(double value, double low, double high)
{
  return static_cast<std::uint64_t>(!(value >= low)) | static_cast<std::uint64_t>(!(value <= high));
}

bool AllWithin(const double* values, std::size_t count, double low, double high)
{
  std::uint64_t bad = 0;
  for (std::size_t k = 0; k < count; ++k) bad |= IsOutside(values[k], low, high);
  return bad == 0;
}

// Returns whether it is so for all parts of a range: are_good(first, count). The threads of a pool, if there is one,
// share the work.
template <class Test>
bool IsSoForAll(WorkerPool* pool, std::size_t count, const Test& are_good)
{
  std::atomic<bool> is_so = true;
  InParts(pool, count, 8,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            if (!are_good(begin, end - begin)) is_so.store(false, std::memory_order_relaxed);
          });
  return is_so;
}

bool IsWithinLimit(const Experiment& experiment, const Vector3& position)
{
  const double limit = experiment.limit_m;
  std::uint64_t bad = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    bad |= IsOutside(position[axis], -limit, experiment.arena_size[axis] + limit);
  return bad == 0;
}

bool AllOfNormOne(const double* qx, const double* qy, const double* qz, const double* qw, std::size_t count)
{
  std::uint64_t bad = 0;
  for (std::size_t k = 0; k < count; ++k)
    bad |= IsOutside(qx[k] * qx[k] + qy[k] * qy[k] + qz[k] * qz[k] + qw[k] * qw[k], 1 - kNormTolerance,
                     1 + kNormTolerance);
  return bad == 0;
}

[[noreturn]] void RefusePose(const CSwarmanoidSpace& space, std::uint32_t entity, const std::array<double, 7>& pose)
{
  for (std::size_t c = 0; c < pose.size(); ++c)
    if (!AllFinite({&pose[c], 1}))
      Refuse(fmt::format("{} has a pose with {} = {}; the numbers of a pose must be finite", NameOf(space, entity),
                         kComponents[c], pose[c]));
  Refuse(fmt::format(
      "{} has an orientation of norm {:.9g} (qx {:g}, qy {:g}, qz {:g}, qw {:g}); it must be 1, so the "
      "quaternion must be normalised",
      NameOf(space, entity), std::sqrt(pose[3] * pose[3] + pose[4] * pose[4] + pose[5] * pose[5] + pose[6] * pose[6]),
      pose[3], pose[4], pose[5], pose[6]));
}

[[noreturn]] void RefuseBeyondLimit(const CSwarmanoidSpace& space, std::uint32_t entity, const Vector3& position)
{
  const Experiment& experiment = space.GetExperiment();
  const Vector3& size = experiment.arena_size;
  Refuse(fmt::format(
      "{} left the world: it is at {:.6g}, {:.6g}, {:.6g}, more than {:g} m outside the arena, which reaches "
      "from 0, 0, 0 to {:g}, {:g}, {:g}; give <arena> a larger limit, or a beyond_limit of hold or remove",
      NameOf(space, entity), position.x(), position.y(), position.z(), experiment.limit_m, size.x(), size.y(),
      size.z()));
}

// Returns the requirement for the values of a slot, or nullptr if the value meets it.
const char* MistakeOf(AttributeValue kind, double value, std::size_t entities)
{
  const auto whole = [value](double most) { return value >= 0 && value <= most && value == std::floor(value); };
  switch (kind)
  {
    case AttributeValue::kNumber:
      return std::abs(value) <= 1e9 ? nullptr : "it must be finite and at most 1e9 from 0";
    case AttributeValue::kColour:
      return whole(0xffffff) ? nullptr : "a colour is a whole number from 0 to 0xffffff";
    case AttributeValue::kSwitch:
      return whole(1) ? nullptr : "it must be 0 or 1";
    case AttributeValue::kEntity:
      return whole(static_cast<double>(entities)) ? nullptr : "it must be 0 or 1 + the index of an entity";
    case AttributeValue::kBytes:
      return whole(0xffffffffff) ? nullptr : "it must be a whole number from 0 to 2^40 - 1";
    case AttributeValue::kPresence:
      return "entities are added and removed by AddEntity and RemoveEntity of the space's editor";
    case AttributeValue::kEngine:
      return "the space server alone hands over entities to engines";
  }
  return nullptr;
}

// Checks the entities that these hands hold; all other hands hold what they hold in the space. A robot may hold one
// movable entity of a kind that can be held. No entity may hold itself through others.
void CheckHands(const CSwarmanoidSpace& space, const std::map<std::uint32_t, std::vector<double>>& hands)
{
  const StructuralTree& structure = space.Structure();
  const auto held_after = [&](std::uint32_t entity)
  {
    const auto changed = hands.find(entity);
    return changed == hands.end() ? structure.GetHeld(entity)
                                  : StructuralTree::HeldBy(space.GetExperiment(), changed->second);
  };
  for (const auto& [gripper, after] : hands)
  {
    const int held = held_after(gripper);
    if (held == StructuralTree::kNothing) continue;
    const std::string mistake = structure.MistakeIn(gripper, static_cast<std::uint32_t>(held), held_after);
    if (!mistake.empty()) Refuse(mistake);
    for (const double hand : after)
      if (const int other = StructuralTree::HeldBy(space.GetExperiment(), {&hand, 1});
          other != StructuralTree::kNothing && other != held)
        Refuse(fmt::format("{} would hold '{}' and '{}': a robot holds one thing at a time", NameOf(space, gripper),
                           space.GetEntity(static_cast<std::size_t>(held)).GetId(),
                           space.GetEntity(static_cast<std::size_t>(other)).GetId()));
  }
}

std::string NameOfSlot(const CSwarmanoidSpace& space, std::uint32_t slot)
{
  if (slot >= space.PresenceSlot(0)) return "the presence of " + NameOf(space, slot - space.PresenceSlot(0));
  const std::uint32_t entity = EntityOfSlot(space, slot);
  std::uint32_t element = slot - space.GetEntity(entity).FirstSlot();
  for (const AttributeSpec& spec : AttributesOf(space.GetEntity(entity).GetKind()))
  {
    const auto count = static_cast<std::uint32_t>(spec.count);
    if (element < count)
      return fmt::format("the attribute '{}'{} of {}", spec.name, count > 1 ? fmt::format(" {}", element) : "",
                         NameOf(space, entity));
    element -= count;
  }
  const Experiment& experiment = space.GetExperiment();
  const EntityConfiguration& configuration = space.GetEntity(entity).GetConfiguration();
  const auto further = static_cast<std::uint32_t>(FurtherMessageSlots(experiment, configuration));
  if (element < further)
  {
    const int own = FindAttribute(configuration.kind, "message")->count;
    return fmt::format("the attribute 'message' {} of {}", element + static_cast<std::uint32_t>(own),
                       NameOf(space, entity));
  }
  element -= further;
  if (element < DepositSlots(experiment, configuration))
    return fmt::format("the rate of deposits on the floor field '{}' of {}", experiment.floor_fields[element].id,
                       NameOf(space, entity));
  element -= static_cast<std::uint32_t>(DepositSlots(experiment, configuration));
  if (element < BatterySlotsOf(experiment, configuration)) return "the battery of " + NameOf(space, entity);
  return "the engine and velocity of " + NameOf(space, entity);
}

}  // namespace

std::uint32_t EntityOfSlot(const CSwarmanoidSpace& space, std::uint32_t slot)
{
  return space.AttributeValues().EntityOf(slot);
}

void CheckPoses(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities, std::span<const double> poses,
                WorkerPool* pool)
{
  const std::size_t count = entities.size();
  if (poses.size() != 7 * count)
    Refuse(fmt::format("there are {} numbers for the poses of {} entities; there must be 7 for each, {}", poses.size(),
                       count, 7 * count));
  const auto of = [&](std::size_t component) { return poses.data() + component * count; };
  // An orientation of norm 1 is finite in all parts, so only positions need the other test.
  const auto are_good = [&](std::size_t first, std::size_t some)
  {
    for (std::size_t c = 0; c < 3; ++c)
      if (!AllFinite({of(c) + first, some})) return false;
    return AllOfNormOne(of(3) + first, of(4) + first, of(5) + first, of(6) + first, some);
  };
  if (IsSoForAll(pool, count, are_good)) return;
  for (std::size_t k = 0; k < count; ++k)
  {
    std::array<double, 7> pose;
    for (std::size_t c = 0; c < pose.size(); ++c) pose[c] = of(c)[k];
    if (!AllFinite(pose) || !AllOfNormOne(&pose[3], &pose[4], &pose[5], &pose[6], 1))
      RefusePose(space, entities[k], pose);
  }
}

std::vector<std::size_t> FindBeyondLimit(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities,
                                         std::span<const double> poses, WorkerPool* pool)
{
  const std::size_t count = entities.size();
  const Experiment& experiment = space.GetExperiment();
  const double limit = experiment.limit_m;
  const auto are_inside = [&](std::size_t first, std::size_t some)
  {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside &= AllWithin(poses.data() + axis * count + first, some, -limit,
                          experiment.arena_size[static_cast<Eigen::Index>(axis)] + limit);
    return inside;
  };
  std::vector<std::size_t> found;
  if (IsSoForAll(pool, count, are_inside)) return found;
  for (std::size_t k = 0; k < count; ++k)
    if (space.IsPresent(entities[k]) && !IsWithinLimit(experiment, {poses[k], poses[count + k], poses[2 * count + k]}))
      found.push_back(k);
  return found;
}

void CheckWithinLimit(const CSwarmanoidSpace& space, std::span<const std::uint32_t> entities,
                      std::span<const double> poses, WorkerPool* pool)
{
  const std::vector<std::size_t> beyond = FindBeyondLimit(space, entities, poses, pool);
  if (beyond.empty()) return;
  const std::size_t count = entities.size();
  const std::size_t first = beyond.front();
  RefuseBeyondLimit(space, entities[first], {poses[first], poses[count + first], poses[2 * count + first]});
}

namespace
{

[[noreturn]] void RefuseOutsideVolumes(const CSwarmanoidSpace& space, std::uint32_t entity, const Vector3& at,
                                       std::span<const std::uint32_t> engines)
{
  Refuse(
      fmt::format("{} left the volumes of all engines that can move it: it is at {:.6g}, {:.6g}, {:.6g}, and they "
                  "are {}; give an engine a larger volume, or write outside=\"keep\" at <arena_physics>",
                  NameOf(space, entity), at.x(), at.y(), at.z(), VolumesText(space.GetExperiment(), engines)));
}

}  // namespace

void CheckInVolumes(const CSwarmanoidSpace& space, std::uint32_t engine, const EngineLayout& layout,
                    std::span<const double> poses)
{
  const Experiment& experiment = space.GetExperiment();
  const EngineChoices& choices = experiment.engine_choices;
  const std::size_t count = layout.owned.size();
  for (const VolumeMember& member : layout.members)
  {
    const std::uint32_t entity = layout.owned[member.place];
    if (!space.IsMovedBy(member.choice, engine) || !space.IsPresent(entity)) continue;
    const Vector3 at(poses[member.place], poses[count + member.place], poses[2 * count + member.place]);
    if (experiment.engines[engine].volume.Holds(at)) continue;
    const std::vector<std::uint32_t>& engines = choices.sets[choices.set_of[member.choice]];
    if (EngineAt(experiment, engines, at) == EngineChoices::kNoEngine) RefuseOutsideVolumes(space, entity, at, engines);
  }
}

void PutPose(const CSwarmanoidSpace& space, const EngineLayout& layout, std::size_t place, std::span<double> poses)
{
  const PoseArrays& all = space.Poses();
  const std::array components{&all.x, &all.y, &all.z, &all.qx, &all.qy, &all.qz, &all.qw};
  for (std::size_t c = 0; c < components.size(); ++c)
    poses[c * layout.owned.size() + place] = (*components[c])[layout.owned[place]];
}

void CheckPose(const CSwarmanoidSpace& space, std::uint32_t entity, const Pose& pose)
{
  const Vector3& p = pose.position;
  const Quaternion& q = pose.orientation;
  const std::array<double, 7> values{p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  CheckPoses(space, {&entity, 1}, values);
  if (!IsWithinLimit(space.GetExperiment(), p))
  {
    const Vector3& size = space.GetExperiment().arena_size;
    Refuse(fmt::format(
        "{} would be at {:.6g}, {:.6g}, {:.6g}, more than {:g} m outside the arena, which reaches from 0, 0, "
        "0 to {:g}, {:g}, {:g}",
        NameOf(space, entity), p.x(), p.y(), p.z(), space.GetExperiment().limit_m, size.x(), size.y(), size.z()));
  }
  if (space.GetExperiment().outside_volumes == OutsideVolumes::kKeep) return;
  const std::span<const std::uint32_t> engines = space.GetExperiment().engine_choices.Of(entity);
  if (!engines.empty() && EngineAt(space.GetExperiment(), engines, p) == EngineChoices::kNoEngine)
    Refuse(fmt::format("{} would be at {:.6g}, {:.6g}, {:.6g}, outside the volumes of all engines that can move it: {}",
                       NameOf(space, entity), p.x(), p.y(), p.z(), VolumesText(space.GetExperiment(), engines)));
}

void CheckAttribute(const CSwarmanoidSpace& space, std::uint32_t slot, double value)
{
  if (slot >= space.Attributes().size())
    Refuse(fmt::format("there is no attribute slot {}; the experiment has {}", slot, space.PresenceSlot(0)));
  const char* mistake = MistakeOf(space.AttributeValues()[slot], value, space.Size());
  if (mistake != nullptr) Refuse(fmt::format("{} is {:.17g}: {}", NameOfSlot(space, slot), value, mistake));
}

void CheckAttributes(const CSwarmanoidSpace& space, const AttributeChanges& changes)
{
  if (changes.slots.size() != changes.values.size())
    Refuse(fmt::format("there are {} values for {} slots of attributes", changes.values.size(), changes.slots.size()));
  for (std::size_t k = 0; k < changes.slots.size(); ++k) CheckAttribute(space, changes.slots[k], changes.values[k]);
}

void CheckHolds(const CSwarmanoidSpace& space, std::span<const std::uint32_t> owned, const AttributeChanges& changes)
{
  const auto is_hold = [&](std::uint32_t slot) { return space.AttributeValues()[slot] == AttributeValue::kEntity; };
  if (std::none_of(changes.slots.begin(), changes.slots.end(), is_hold)) return;
  // `hands` has, for each entity with a changed hand, the values of all its hands afterwards.
  std::map<std::uint32_t, std::vector<double>> hands;
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    if (!is_hold(changes.slots[k])) continue;
    const std::uint32_t gripper = EntityOfSlot(space, changes.slots[k]);
    const std::span<const double> before = space.Hands(gripper);
    std::vector<double>& after = hands.try_emplace(gripper, before.begin(), before.end()).first->second;
    after[changes.slots[k] - space.FirstHandSlot(gripper)] = changes.values[k];
  }
  CheckHands(space, hands);
  for (const auto& [gripper, after] : hands)
    for (const double hand : after)
      if (hand != 0 && space.GetEntity(static_cast<std::size_t>(hand) - 1).IsMovable())
        for (const std::uint32_t one : {gripper, static_cast<std::uint32_t>(hand) - 1})
          if (!std::binary_search(owned.begin(), owned.end(), one))
            Refuse(fmt::format("{} would hold '{}', but the engine does not move {}", NameOf(space, gripper),
                               space.GetEntity(static_cast<std::size_t>(hand) - 1).GetId(), NameOf(space, one)));
}

void CheckIsNoHold(const CSwarmanoidSpace& space, std::uint32_t slot)
{
  if (space.AttributeValues()[slot] == AttributeValue::kEntity)
    Refuse(NameOfSlot(space, slot) +
           " is told by the engine that moves it; only 0, to let go, can be set from outside");
}

void CheckSnapshot(const CSwarmanoidSpace& space, const SpaceSnapshot& snapshot)
{
  if (snapshot.poses.size() != 7 * space.Movable().size() || snapshot.attributes.size() != space.Attributes().size())
    Refuse("it has other entities");
  if (const std::string mistake = MistakeIn(snapshot.fields, FloorFieldCells(space.GetExperiment())); !mistake.empty())
    Refuse(mistake);
  CheckPoses(space, space.Movable(), snapshot.poses);
  const std::uint32_t first_presence = space.PresenceSlot(0);
  for (std::uint32_t slot = 0; slot < first_presence; ++slot)
    if (space.AttributeValues()[slot] != AttributeValue::kEngine)
      CheckAttribute(space, slot, snapshot.attributes[slot]);
  const EngineChoices& choices = space.GetExperiment().engine_choices;
  for (std::size_t k = 0; k < choices.entities.size(); ++k)
    for (const std::uint32_t part : {EngineSlots::kEngine, EngineSlots::kBefore})
    {
      const double engine = snapshot.attributes[space.EngineSlot(k) + part];
      const std::vector<std::uint32_t>& engines = choices.sets[choices.set_of[k]];
      if (std::none_of(engines.begin(), engines.end(), [&](std::uint32_t one) { return one == engine; }))
        Refuse(fmt::format("{} is {}: it is no engine that can move it", NameOfSlot(space, space.EngineSlot(k) + part),
                           engine));
    }
  std::map<std::uint32_t, std::vector<double>> hands;
  for (std::uint32_t i = 0; i < space.Size(); ++i)
    if (const std::size_t count = space.Hands(i).size(); count > 0)
    {
      const auto first = snapshot.attributes.begin() + static_cast<std::ptrdiff_t>(space.FirstHandSlot(i));
      hands.try_emplace(i, first, first + static_cast<std::ptrdiff_t>(count));
    }
  CheckHands(space, hands);
  for (std::uint32_t slot = first_presence; slot < snapshot.attributes.size(); ++slot)
    if (snapshot.attributes[slot] != 0 && snapshot.attributes[slot] != 1)
      Refuse(fmt::format("{} is {}: it must be 0 or 1", NameOfSlot(space, slot), snapshot.attributes[slot]));
}

void CheckChannels(const CSwarmanoidSpace& space, std::span<const ChannelBlock> blocks, std::span<const double> values,
                   const char* what)
{
  if (AllFinite(values)) return;
  for (const ChannelBlock& block : blocks)
  {
    const auto width = static_cast<std::size_t>(block.width);
    for (std::size_t k = 0; k < block.entities.size(); ++k)
      for (std::size_t i = 0; i < width; ++i)
        if (const double value = values[block.offset + k * width + i]; !AllFinite({&value, 1}))
          Refuse(fmt::format("the {} of {} on the channel '{}' hold {}; they must be finite", what,
                             NameOf(space, block.entities[k]), block.name, value));
  }
}

}  // namespace swarmanoid
