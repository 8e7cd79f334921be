#include "common/bus/membership/tick_limits.h"

#include <fmt/format.h>
#include <numeric>

#include "common/bus/topics/message_bytes.h"
#include "common/configuration/shown_text.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

std::size_t Largest(const std::vector<std::size_t>& numbers)
{
  return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
}

void FillSlots(AttributeChanges& changes, std::size_t slots)
{
  for (std::size_t slot = 0; slot < slots; ++slot) changes.Add(static_cast<std::uint32_t>(slot), 0);
}

// The values are all different, so that no column is shorter on the wire.
void FillPoses(std::vector<double>& poses, std::size_t entities)
{
  poses.resize(kPoseColumns * entities);
  std::iota(poses.begin(), poses.end(), 0.0);
}

void FillDrawing(Drawing& drawing)
{
  drawing.shapes.resize(Drawing::kMostShapes);
  drawing.numbers.resize(Drawing::kMostNumbers);
  drawing.texts.assign(Drawing::kMostTexts, std::string(Drawing::kLongestText, ' '));
}

// The longest message changes every other cell, or all cells.
void FillCells(FieldCells& cells, std::size_t all)
{
  cells.runs.resize(all + 2);
  cells.values.resize(all);
}

void CheckLength(const char* field, std::size_t length, std::size_t wanted)
{
  if (length != wanted) RefuseField(field, fmt::format("it has {} numbers, not {}", length, wanted));
}

// Returns the entry of the sender that the message names.
std::size_t OfSource(const std::vector<std::size_t>& numbers, const MessageHeader& header)
{
  TickLimits::CheckSource(header, numbers.size());
  return numbers[header.source];
}

// Covers fixed parts, and small crowds with many grips.
constexpr std::size_t kRegionAtLeast = 1 << 20;

}  // namespace

// A body needs its state and a grip; a mirror also needs its outline.
std::size_t RegionLimits::TaskBytes() const { return kRegionAtLeast + 144 * bodies + 4096 * mirrors; }
// The size is twice that of all bodies changing their regions at once.
std::size_t RegionLimits::HaloBytes() const { return kRegionAtLeast + 256 * bodies; }
// A body needs its motion, turret, way and load.
std::size_t RegionLimits::ResultBytes() const { return kRegionAtLeast + 112 * bodies; }

TickLimits::TickLimits(const CSwarmanoidSpace& space, const Assignment& assignment, bool recorded)
    : entities_(space.Size()),
      movable_(space.Movable().size()),
      slots_(space.Attributes().size()),
      cells_(FloorFieldCells(space.GetExperiment())),
      sets_cells_(cells_ > 0 && !space.GetExperiment().functions.empty()),
      draws_(!space.GetExperiment().functions.empty() && !space.GetExperiment().visualisations.empty())
{
  const Experiment& experiment = space.GetExperiment();
  for (const EntityConfiguration& entity : experiment.entities)
  {
    const ControllerConfiguration* controller = experiment.FindController(entity.controller);
    is_movable_.push_back(entity.movable);
    may_fail_.push_back(controller != nullptr && controller->MayFail());
  }
  for (const HostLayout& host : assignment.hosts) command_values_.push_back(host.command_size);
  for (std::size_t e = 0; e < assignment.engines.size(); ++e)
  {
    if (experiment.engines[e].split.regions < 2) continue;
    most_in_regions_ = std::max(most_in_regions_, assignment.engines[e].owned.size());
    most_mirrors_ = std::max(most_mirrors_, assignment.engines[e].mirrored.size());
  }
  for (const EngineLayout& engine : assignment.engines)
  {
    owned_.push_back(engine.owned.size());
    sensor_values_.push_back(engine.sensor_size);
    recorded_.push_back(recorded ? engine.command_size + engine.sensor_size : 0);
  }
}

std::size_t TickLimits::StateBytes() const
{
  SpaceState state;
  FillPoses(state.poses, movable_);
  FillSlots(state.attributes, slots_);
  state.moved.resize(entities_);
  if (sets_cells_) FillCells(state.fields, cells_);
  if (draws_) FillDrawing(state.drawing);
  return PayloadSize(MessageHeader(), state);
}

std::size_t TickLimits::LocalStateBytes() const
{
  LocalState state;
  FillPoses(state.poses, movable_);
  FillSlots(state.attributes, slots_);
  state.entities.resize(movable_);
  state.near.resize((movable_ + 31) / 32);
  state.moved.resize(entities_);
  return PayloadSize(MessageHeader(), state);
}

std::size_t TickLimits::CommandBytes() const
{
  ControlCommands commands;
  commands.values.resize(Largest(command_values_));
  FillSlots(commands.attributes, slots_);
  commands.faults.robots.resize(static_cast<std::size_t>(std::count(may_fail_.begin(), may_fail_.end(), true)));
  commands.faults.kinds.resize(commands.faults.robots.size());
  if (!commands.faults.robots.empty()) commands.faults.texts.resize(commands.faults.robots.size() + kMostFaultText);
  return PayloadSize(MessageHeader(), commands);
}

std::size_t TickLimits::UpdateBytes() const
{
  EngineUpdate update;
  FillPoses(update.poses, Largest(owned_));
  FillSlots(update.attributes, slots_);
  update.recorded.resize(Largest(recorded_));
  return PayloadSize(MessageHeader(), update);
}

std::size_t TickLimits::FrameBytes() const
{
  SensorFrame frame;
  frame.values.resize(Largest(sensor_values_));
  return PayloadSize(MessageHeader(), frame);
}

std::size_t TickLimits::DrawnBytes() { return PayloadSize(MessageHeader(), DrawnMessage()); }

void TickLimits::Check(const MessageHeader& header, const SpaceState& state) const
{
  if (header.source != 0) RefuseField("source", "the space server is number 0");
  CheckLength("poses", state.poses.size(), kPoseColumns * movable_);
  CheckSlots(state.attributes);
  CheckMoved(state.moved);
  if (!sets_cells_ && !state.fields.values.empty()) RefuseField("fields", "nothing changes floor fields in this run");
  CheckCells(state.fields);
  if (!draws_ && !state.drawing.IsEmpty()) RefuseField("shapes", "nothing draws in this run");
  CheckDrawing(state.drawing);
}

// The subscriber has already checked that the message is addressed to this process.
void TickLimits::Check(const MessageHeader&, const LocalState& state) const
{
  for (std::size_t k = 0; k < state.entities.size(); ++k)
  {
    const std::uint32_t entity = state.entities[k];
    if (entity >= entities_ || !is_movable_[entity] || (k > 0 && entity <= state.entities[k - 1]))
      RefuseField("entities", fmt::format("entity {} of {} does not ascend, or cannot move", entity, entities_));
  }
  CheckLength("poses", state.poses.size(), kPoseColumns * state.entities.size());
  if (!state.near.empty()) CheckLength("near", state.near.size(), (movable_ + 31) / 32);
  CheckSlots(state.attributes);
  CheckMoved(state.moved);
}

void TickLimits::CheckMoved(const std::vector<std::uint32_t>& moved) const
{
  for (std::size_t k = 0; k < moved.size(); ++k)
    if (moved[k] >= entities_ || (k > 0 && moved[k] <= moved[k - 1]))
      RefuseField("moved", fmt::format("entity {} of {} does not ascend, or there is none", moved[k], entities_));
}

void TickLimits::CheckCells(const FieldCells& cells) const
{
  if (const std::string mistake = MistakeIn(cells, cells_); !mistake.empty()) RefuseField("fields", mistake);
}

void TickLimits::CheckDrawing(const Drawing& drawing) const
{
  if (const std::string mistake = drawing.Mistake(entities_); !mistake.empty()) RefuseField("shapes", mistake);
}

void TickLimits::Check(const MessageHeader& header, const ControlCommands& commands) const
{
  CheckLength("values", commands.values.size(), OfSource(command_values_, header));
  CheckSlots(commands.attributes);
  CheckFaults(commands.faults);
}

void TickLimits::Check(const MessageHeader& header, const EngineUpdate& update) const
{
  CheckLength("poses", update.poses.size(), kPoseColumns * OfSource(owned_, header));
  CheckSlots(update.attributes);
  CheckLength("recorded", update.recorded.size(), recorded_[header.source]);
}

void TickLimits::Check(const MessageHeader& header, const SensorFrame& frame) const
{
  CheckLength("values", frame.values.size(), OfSource(sensor_values_, header));
}

void TickLimits::Check(const SpaceSnapshot& snapshot) const
{
  CheckLength("poses", snapshot.poses.size(), kPoseColumns * movable_);
  CheckLength("attributes", snapshot.attributes.size(), slots_);
  CheckCells(snapshot.fields);
  CheckDrawing(snapshot.drawing);
}

void TickLimits::CheckSource(const MessageHeader& header, std::size_t senders)
{
  if (header.source >= senders) RefuseField("source", fmt::format("there is no number {}", header.source));
}

template <>
void TickLimits::CheckSource<ControlCommands>(const MessageHeader& header) const
{
  CheckSource(header, command_values_.size());
}

template <>
void TickLimits::CheckSource<SensorFrame>(const MessageHeader& header) const
{
  CheckSource(header, sensor_values_.size());
}

void TickLimits::CheckFaults(const ControllerFaults& faults) const
{
  CheckLength("faults.kinds", faults.kinds.size(), faults.robots.size());
  if (!IsShowable({faults.texts.data(), faults.texts.size()}))
    RefuseField("faults.texts", "they have characters that must not be shown");
  for (std::size_t k = 0; k < faults.robots.size(); ++k)
  {
    const std::uint32_t robot = faults.robots[k];
    if (robot >= entities_ || !may_fail_[robot] || (k > 0 && robot <= faults.robots[k - 1]))
      RefuseField("faults.robots", fmt::format("entity {} does not ascend, or may not fail", robot));
    if (faults.kinds[k] < FaultKind::kThrew || faults.kinds[k] > FaultKind::kTooSlow)
      RefuseField("faults.kinds", fmt::format("there is no kind {}", static_cast<std::uint32_t>(faults.kinds[k])));
  }
}

// The slots ascend, so the last one is the largest.
void TickLimits::CheckSlots(const AttributeChanges& changes) const
{
  const std::vector<std::uint32_t>& slots = changes.slots;
  if (!slots.empty() && slots.back() >= slots_)
    RefuseField("attributes.slots", fmt::format("there is no slot {}; there are {}", slots.back(), slots_));
}

}  // namespace swarmanoid
