// The next state is the last one, changed by the commands of the hosts and then by the updates of the engines. Both are
// merged in the order of their numbers. The order of arrival has no influence. After that the experiment functions may
// change the space.
//
// Invariants: every value is checked before any is merged (Check); an entity that is moved from outside leaves all
// grips but those with entities that move together with it; drawing and input have random streams of their own, so that
// a run that is drawn has the same numbers as one that is not.
#include "space_server/space_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "common/experiment/actors.h"
#include "common/logging/log.h"
#include "common/space/bound_entities.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "common/threads/worker_pool.h"

namespace swarmanoid
{

SpaceServer::SpaceServer(const Experiment& experiment, const Assignment& assignment, const std::string& output_folder)
    : experiment_(experiment),
      assignment_(assignment),
      space_(experiment),
      batteries_(space_),
      editor_(*this, output_folder),
      program_random_(experiment.seed, StreamName("program"), StreamName("between steps")),
      warn_([](const std::string& text) { LogWarning("{}", text); })
{
  for (const FunctionsConfiguration& configuration : experiment.functions)
  {
    const auto* entry = PluginRegistry<CExperimentFunctions>::Instance().Find(configuration.tag);
    if (entry == nullptr)
      throw ConfigurationError(configuration.location,
                               "no experiment functions are registered as '" + configuration.tag + "'");
    const Actor actor =
        FunctionsActor(experiment, static_cast<std::size_t>(&configuration - experiment.functions.data()));
    functions_.push_back({&configuration, actor, nullptr, {}});
    RunCodeOf<ConfigurationError>(actor, ActivityStep::kInit, 0, [&] { functions_.back().object = entry->create(); });
  }
  CallFunctions(ActivityStep::kInit,
                [this](const Functions& functions) { functions.object->Init(functions.configuration->tree, editor_); });
  AskWhetherFinished();
  if (!IsLast())
    CallFunctions(ActivityStep::kPreStep, [this](const Functions& functions) { functions.object->PreStep(editor_); });
  editor_.BeginStep({program_random_, space_.StreamTick()});
}

SpaceServer::~SpaceServer() = default;

const SpaceState& SpaceServer::State()
{
  SpaceState& state = states_[space_.GetTick() % 2];
  state.tick = space_.GetTick();
  state.last = IsLast();
  space_.WritePoses(state.poses);
  std::sort(changed_slots_.begin(), changed_slots_.end());
  changed_slots_.erase(std::unique(changed_slots_.begin(), changed_slots_.end()), changed_slots_.end());
  state.attributes.Clear();
  for (const std::uint32_t slot : changed_slots_) state.attributes.Add(slot, space_.Attributes()[slot]);
  std::sort(changed_cells_.begin(), changed_cells_.end());
  changed_cells_.erase(std::unique(changed_cells_.begin(), changed_cells_.end()), changed_cells_.end());
  state.fields.runs.clear();
  state.fields.values.clear();
  for (const std::uint32_t cell : changed_cells_) AddCell(state.fields, cell, space_.Fields().ValueOf(cell));
  const auto moved = Moved();
  state.moved.assign(moved.begin(), moved.end());
  if (draws_into_states_) state.drawing = space_.GetDrawing();
  return state;
}

std::span<const std::uint32_t> SpaceServer::Moved()
{
  std::sort(moved_.begin(), moved_.end());
  moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
  return moved_;
}

void SpaceServer::WriteSnapshot(SpaceSnapshot& snapshot) const
{
  snapshot.tick = space_.GetTick();
  snapshot.last = IsLast();
  space_.WritePoses(snapshot.poses);
  snapshot.attributes.assign(space_.Attributes().Values().begin(), space_.Attributes().Values().end());
  space_.Fields().WriteCells(snapshot.fields);
}

void SpaceServer::Resend(const SpaceState& state)
{
  changed_slots_ = state.attributes.slots;
  changed_cells_.clear();
  for (std::size_t k = 0; k + 1 < state.fields.runs.size(); k += 2)
    for (std::uint32_t n = 0; n < state.fields.runs[k + 1]; ++n) changed_cells_.push_back(state.fields.runs[k] + n);
}

void SpaceServer::SetFieldCell(std::uint32_t cell, float value)
{
  space_.Fields().Set(cell, value);
  changed_cells_.push_back(cell);
}

void SpaceServer::BeginAgain(std::uint64_t first_tick, std::uint32_t variation)
{
  if (!shares_space_) throw std::logic_error("BeginAgain needs all roles in one process: run it with --single-process");
  space_.BeginAgain(first_tick, variation);
  batteries_.Reset([this](std::uint32_t slot, double value) { Change(slot, value); });
}

void SpaceServer::SaveState(ByteWriter& state) const
{
  if (space_.FirstTick() != 0)
    throw std::runtime_error("experiment functions began the run again; such a run cannot be saved");
  state.Put(last_);
  state.Put(failed_);
  state.PutArray(moved_);
  state.Put(selected_);
  for (const Functions& functions : functions_)
  {
    if (!functions.object->HasState())
      throw std::runtime_error("experiment functions '" + functions.configuration->id +
                               "' cannot be saved; they must override HasState, SaveState and LoadState");
    std::ostringstream text;
    RunCodeOf(functions.actor, ActivityStep::kSaveState, space_.GetTick(), [&] { functions.object->SaveState(text); });
    state.PutText(text.str());
  }
}

void SpaceServer::LoadState(const SpaceSnapshot& snapshot, ByteReader& state)
{
  CheckSnapshot(space_, snapshot);
  space_.Apply(snapshot);
  changed_slots_.clear();
  changed_cells_.clear();
  last_ = state.Get<bool>();
  failed_ = state.Get<bool>();
  failure_ = failed_ ? "it had failed before the state that it continues from" : "";
  moved_ = state.GetArray<std::uint32_t>();
  for (const std::uint32_t entity : moved_)
    if (entity >= space_.Size()) throw std::runtime_error("it moved an entity that does not exist");
  selected_ = state.Get<std::uint32_t>();
  if (selected_ != kNobody && selected_ >= space_.Size())
    throw std::runtime_error("it has selected an entity that does not exist");
  drawn_at_.reset();
  for (const Functions& functions : functions_)
  {
    std::istringstream text(state.GetText());
    RunCodeOf(functions.actor, ActivityStep::kLoadState, space_.GetTick(), [&] { functions.object->LoadState(text); });
  }
}

void SpaceServer::Advance(std::span<const EngineUpdate* const> updates,
                          std::span<const ControlCommands* const> commands)
{
  space_.AdvanceFields();
  batteries_.BeginTick();
  changed_slots_.clear();
  changed_cells_.clear();
  moved_.clear();
  for (const ControlCommands* command : commands) Merge(command->attributes);
  TellFaults(commands);
  for (const EngineUpdate* update : updates) Merge(*update);
  HandOverAll();
  batteries_.Advance([this](std::uint32_t slot, double value) { Change(slot, value); });
  space_.SetTick(space_.GetTick() + 1);

  CallFunctions(ActivityStep::kPostStep, [this](const Functions& functions) { functions.object->PostStep(editor_); });
  AskWhetherFinished();
  if (!IsLast())
    CallFunctions(ActivityStep::kPreStep, [this](const Functions& functions) { functions.object->PreStep(editor_); });
  editor_.BeginStep({program_random_, space_.StreamTick()});
}

// Faults are reported in the order of the entities, for any assignment to hosts.
void SpaceServer::TellFaults(std::span<const ControlCommands* const> commands) const
{
  // The commands come from the control steps of this earlier tick.
  const std::uint64_t tick = space_.GetTick() - std::min<std::uint64_t>(space_.GetTick(), experiment_.ahead);
  std::vector<RecordedFault> faults;
  for (const ControlCommands* command : commands)
  {
    if (command->faults.robots.empty()) continue;
    std::vector<std::string> texts = TextsOf(command->faults);
    for (std::size_t k = 0; k < texts.size(); ++k)
      faults.push_back({tick, command->faults.robots[k], command->faults.kinds[k], std::move(texts[k])});
  }
  if (faults.empty() || !fault_) return;
  std::sort(faults.begin(), faults.end());
  fault_(faults);
}

void SpaceServer::SetAttribute(std::uint32_t slot, double value)
{
  CheckAttribute(space_, slot, value);
  if (space_.AttributeValues()[slot] != AttributeValue::kEntity) return Change(slot, value);
  if (value != 0) CheckIsNoHold(space_, slot);
  const auto held = static_cast<std::uint32_t>(space_.Attributes()[slot]);
  if (held == 0) return;
  const std::uint32_t gripper = EntityOfSlot(space_, slot);
  EndHold(gripper, held - 1);
  moved_.push_back(gripper);
}

void SpaceServer::Change(std::uint32_t slot, double value)
{
  if (space_.Attributes()[slot] == value) return;
  space_.SetAttribute(slot, value);
  changed_slots_.push_back(slot);
}

void SpaceServer::Destroy()
{
  if (destroyed_) return;
  destroyed_ = true;
  CallFunctions(ActivityStep::kDestroy, [this](const Functions& functions) { functions.object->Destroy(editor_); });
}

template <class Call>
void SpaceServer::CallFunctions(ActivityStep step, Call call)
{
  if (functions_.empty()) return;
  for (Functions& functions : functions_)
  {
    std::optional<StreamKey>& stream = functions.streams[static_cast<std::size_t>(step)];
    if (!stream)
      stream.emplace(experiment_.seed, StreamName(functions.configuration->id),
                     StreamName(std::string("functions ") + NameOf(step)));
    editor_.BeginStep({*stream, space_.StreamTick()});
    RunCodeOf<ConfigurationError>(functions.actor, step, space_.GetTick(), [&] { call(functions); });
  }
}

void SpaceServer::Draw()
{
  if (functions_.empty()) return;
  const DrawnAt now{space_.GetTick(), space_.Revision(), space_.AttributeRevision(), inputs_};
  if (drawn_at_ == now) return;
  drawn_at_ = now;
  drawing_.Clear();
  RandomStream before = editor_.LeaveStep();
  CallFunctions(ActivityStep::kDraw,
                [this](const Functions& functions)
                {
                  drawing_.InSpace();
                  functions.object->Draw(editor_, drawing_);
                });
  editor_.BeginStep(std::move(before));
  if (const std::string mistake = drawing_.Mistake(space_.Size()); !mistake.empty())
    throw std::runtime_error(
        fmt::format("what experiment functions draw at tick {} is wrong: {}", space_.GetTick(), mistake));
  if (drawing_.IsFull() && !std::exchange(told_full_, true))
    warn_(fmt::format("experiment functions draw more at tick {} than is shown: {} shapes, {} numbers or {} texts",
                      space_.GetTick(), Drawing::kMostShapes, Drawing::kMostNumbers, Drawing::kMostTexts));
  space_.SwapDrawing(drawing_);
}

void SpaceServer::RequireFunctions() const
{
  if (functions_.empty())
    throw std::invalid_argument("the experiment has no <experiment_functions> that keys and selections could go to");
}

void SpaceServer::Tell(const UserInput& input)
{
  ++inputs_;
  RandomStream before = editor_.LeaveStep();
  CallFunctions(ActivityStep::kInput, [&](const Functions& functions) { functions.object->Input(input, editor_); });
  editor_.BeginStep(std::move(before));
}

void SpaceServer::PressKey(const std::string& key, bool pressed)
{
  RequireFunctions();
  if (!IsKeyName(key))
    throw std::invalid_argument(
        fmt::format("there is no key '{}'; keys are A to Z, 0 to 9, the sign on them, Up, Down, Left, Right, Space, "
                    "Return, Escape, Tab, Backspace, Delete, Insert, Home, End, PageUp, PageDown, Shift, Control, Alt "
                    "and F1 to F12",
                    key));
  Tell({pressed ? UserInput::Kind::kKeyPressed : UserInput::Kind::kKeyReleased, key, nullptr});
}

void SpaceServer::Select(const std::string& id)
{
  RequireFunctions();
  const CSwarmanoidSpaceEntity* entity = id.empty() ? nullptr : space_.FindEntity(id);
  if (!id.empty() && entity == nullptr) throw std::invalid_argument("there is no entity '" + id + "'");
  const std::uint32_t index = entity == nullptr ? kNobody : entity->GetIndex();
  if (index == selected_) return;
  if (selected_ != kNobody) Tell({UserInput::Kind::kDeselected, {}, &space_.GetEntity(selected_)});
  selected_ = index;
  if (entity != nullptr) Tell({UserInput::Kind::kSelected, {}, entity});
}

void SpaceServer::AskWhetherFinished()
{
  CallFunctions(ActivityStep::kIsFinished,
                [this](const Functions& functions)
                {
                  const auto outcome = functions.object->IsFinished(editor_);
                  if (outcome == CExperimentFunctions::Outcome::kRunning) return;
                  last_ = true;
                  if (outcome != CExperimentFunctions::Outcome::kFailed) return;
                  failed_ = true;
                  const std::string& reason = functions.object->FailureReason();
                  failure_ +=
                      fmt::format("{}experiment functions '{}' {}{}", failure_.empty() ? "" : "; ",
                                  functions.configuration->id, reason.empty() ? "gave no reason" : "say: ", reason);
                });
}

void SpaceServer::Move(std::span<const MoveRequest> requests)
{
  for (const MoveRequest& request : requests)
    if (request.present) CheckPose(space_, request.entity, request.pose);
  Put(requests);
}

void SpaceServer::Put(std::span<const MoveRequest> requests)
{
  std::vector<std::uint32_t> together;
  for (const MoveRequest& request : requests)
    if (request.present) together.push_back(request.entity);
  std::sort(together.begin(), together.end());
  for (const MoveRequest& request : requests)
  {
    if (request.present)
      EndHolds(request.entity, together);
    else
      EndHolds(request.entity, {});
    space_.SetPose(request.entity, request.pose);
    Change(space_.PresenceSlot(request.entity), request.present ? 1 : 0);
    moved_.push_back(request.entity);
  }
  for (const MoveRequest& request : requests)
  {
    const std::size_t choice = experiment_.engine_choices.PlaceOf(request.entity);
    if (choice == experiment_.engine_choices.entities.size()) continue;
    const std::uint32_t slot = space_.EngineSlot(choice);
    for (std::uint32_t part = EngineSlots::kVelocity; part < EngineSlots::kCount; ++part) Change(slot + part, 0);
    HandOver(choice, true);
    // No engine has sensed anything before the first tick.
    if (space_.GetTick() == space_.FirstTick())
      Change(slot + EngineSlots::kBefore, space_.Attributes()[slot + EngineSlots::kEngine]);
  }
}

void SpaceServer::EndHolds(std::uint32_t entity, std::span<const std::uint32_t> kept)
{
  const auto is_kept = [&](std::uint32_t other) { return std::binary_search(kept.begin(), kept.end(), other); };
  for (const std::uint32_t holder : space_.Structure().GetHolders(entity))
    if (!is_kept(holder)) EndHold(holder, entity);
  const std::span<const double> hands = space_.Hands(entity);
  for (const double hand : std::vector<double>(hands.begin(), hands.end()))
    if (const auto held = static_cast<std::uint32_t>(hand); held != 0 && !is_kept(held - 1)) EndHold(entity, held - 1);
}

void SpaceServer::EndHold(std::uint32_t gripper, std::uint32_t gripped)
{
  const std::size_t hands = space_.Hands(gripper).size();
  for (std::size_t hand = 0; hand < hands; ++hand)
    if (space_.Hands(gripper)[hand] == 1.0 + gripped)
      Change(space_.FirstHandSlot(gripper) + static_cast<std::uint32_t>(hand), 0);
}

void SpaceServer::Check(const ControlCommands& commands) const
{
  try
  {
    CheckAttributes(space_, commands.attributes);
    for (const std::uint32_t slot : commands.attributes.slots) CheckIsNoHold(space_, slot);
  }
  catch (const StateError& error)
  {
    throw std::runtime_error(fmt::format("{} at tick {}: {}", HostName(commands.host), space_.GetTick(), error.what()));
  }
}

void SpaceServer::Check(const EngineUpdate& update) const
{
  if (update.engine >= assignment_.engines.size())
    throw std::runtime_error(fmt::format("an update of engine {} came, but there are {} engines", update.engine,
                                         assignment_.engines.size()));
  const std::vector<std::uint32_t>& owned = assignment_.engines[update.engine].owned;
  try
  {
    CheckPoses(space_, owned, update.poses);
    CheckAttributes(space_, update.attributes);
    CheckHolds(space_, owned, update.attributes);
    if (experiment_.beyond_limit == BeyondLimit::kStop) CheckWithinLimit(space_, owned, update.poses);
    if (experiment_.outside_volumes == OutsideVolumes::kStop)
      CheckInVolumes(space_, update.engine, assignment_.engines[update.engine], update.poses);
  }
  catch (const StateError& error)
  {
    throw std::runtime_error(
        fmt::format("{} at tick {}: {}", EngineName(experiment_, update.engine), space_.GetTick(), error.what()));
  }
}

void SpaceServer::Merge(const EngineUpdate& update)
{
  const std::vector<std::uint32_t>& owned = assignment_.engines[update.engine].owned;
  const EngineUpdate& own = OwnPart(update);
  // Entities beyond the limit release their grips first.
  Merge(own.attributes);
  if (experiment_.beyond_limit == BeyondLimit::kStop)
    space_.SetPoses(owned, own.poses);
  else
    SetPosesWithinLimit(own, owned);
}

const EngineUpdate& SpaceServer::OwnPart(const EngineUpdate& update)
{
  const EngineLayout& layout = assignment_.engines[update.engine];
  if (layout.changing.empty()) return update;
  own_part_ = update;
  for (const VolumeMember& member : layout.members)
    if (!space_.IsMovedBy(member.choice, update.engine)) PutPose(space_, layout, member.place, own_part_.poses);
  return own_part_;
}

void SpaceServer::HandOverAll()
{
  for (std::size_t choice = 0; choice < experiment_.engine_choices.entities.size(); ++choice)
  {
    const std::uint32_t slot = space_.EngineSlot(choice);
    Change(slot + EngineSlots::kBefore, space_.Attributes()[slot + EngineSlots::kEngine]);
    HandOver(choice, false);
  }
}

void SpaceServer::HandOver(std::size_t choice, bool was_put)
{
  const EngineChoices& choices = experiment_.engine_choices;
  const std::uint32_t entity = choices.entities[choice];
  const std::uint32_t slot = space_.EngineSlot(choice) + EngineSlots::kEngine;
  const auto now = static_cast<std::size_t>(space_.Attributes()[slot]);
  const Vector3 at = space_.GetPose(entity).position;
  if (!space_.IsPresent(entity) || (!was_put && experiment_.engines[now].volume.Holds(at)) || IsBound(space_, entity))
    return;
  const std::uint32_t next = EngineAt(experiment_, choices.sets[choices.set_of[choice]], at);
  if (next != EngineChoices::kNoEngine) Change(slot, next);
}

void SpaceServer::SetPosesWithinLimit(const EngineUpdate& update, std::span<const std::uint32_t> owned)
{
  const std::vector<std::size_t> beyond = FindBeyondLimit(space_, owned, update.poses, IfItShares(pool_));
  std::vector<Pose> before;
  for (const std::size_t k : beyond) before.push_back(space_.GetPose(owned[k]));
  space_.SetPoses(owned, update.poses);

  const bool hold = experiment_.beyond_limit == BeyondLimit::kHold;
  told_.resize(space_.Size());
  for (std::size_t n = 0; n < beyond.size(); ++n)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(owned[beyond[n]]);
    if (const std::uint32_t index = entity.GetIndex(); !hold || !told_[index])
    {
      const Vector3 at = entity.GetPosition();
      warn_(fmt::format(
          "{} at tick {}: the {} '{}' left the world at {:.6g}, {:.6g}, {:.6g}, more than {:g} m outside the arena; it "
          "is {}",
          EngineName(experiment_, update.engine), space_.GetTick(), TagName(entity.GetKind()), entity.GetId(), at.x(),
          at.y(), at.z(), experiment_.limit_m, hold ? "held where it was before" : "removed"));
      told_[index] = true;
    }
    const MoveRequest back{entity.GetIndex(), before[n]};
    const MoveRequest out{entity.GetIndex(), WaitingPose(entity.GetConfiguration(), entity.GetIndex()), false};
    Put({hold ? &back : &out, 1});
  }
}

void SpaceServer::Merge(const AttributeChanges& changes)
{
  for (std::size_t k = 0; k < changes.slots.size(); ++k) Change(changes.slots[k], changes.values[k]);
}

}  // namespace swarmanoid
