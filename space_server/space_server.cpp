#include "space_server/space_server.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace swarmanoid
{

SpaceServer::SpaceServer(const Experiment& experiment, const Assignment& assignment, const std::string& output_folder)
    : experiment_(experiment), assignment_(assignment), space_(experiment), editor_(*this, output_folder)
{
  for (const FunctionsConfiguration& configuration : experiment.functions)
  {
    const auto* entry = PluginRegistry<CExperimentFunctions>::Instance().Find(configuration.tag);
    if (entry == nullptr)
      throw ConfigurationError(configuration.location,
                               "no experiment functions are registered as '" + configuration.tag + "'");
    functions_.push_back({&configuration, entry->create()});
  }
  CallFunctions("Init",
                [this](const Functions& functions) { functions.object->Init(functions.configuration->tree, editor_); });
  AskWhetherFinished();
  if (!IsLast()) CallFunctions("PreStep", [this](const Functions& functions) { functions.object->PreStep(editor_); });
}

SpaceServer::~SpaceServer() = default;

const SpaceState& SpaceServer::State()
{
  state_.tick = space_.GetTick();
  state_.last = IsLast();
  space_.WritePoses(state_.poses);
  std::sort(changed_slots_.begin(), changed_slots_.end());
  changed_slots_.erase(std::unique(changed_slots_.begin(), changed_slots_.end()), changed_slots_.end());
  state_.attributes.Clear();
  for (const std::uint32_t slot : changed_slots_) state_.attributes.Add(slot, space_.Attributes()[slot]);
  const auto moved = Moved();
  state_.moved.assign(moved.begin(), moved.end());
  return state_;
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
  snapshot.attributes.assign(space_.Attributes().begin(), space_.Attributes().end());
}

void SpaceServer::SaveState(ByteWriter& state) const
{
  state.Put(last_);
  state.Put(failed_);
  state.PutArray(moved_);
  for (const Functions& functions : functions_)
  {
    if (!functions.object->HasState())
      throw std::runtime_error("experiment functions '" + functions.configuration->id +
                               "' cannot be saved; they must override HasState, SaveState and LoadState");
    std::ostringstream text;
    functions.object->SaveState(text);
    state.PutText(text.str());
  }
}

void SpaceServer::LoadState(const SpaceSnapshot& snapshot, ByteReader& state)
{
  if (snapshot.poses.size() != 7 * space_.Movable().size() || snapshot.attributes.size() != space_.Attributes().size())
    throw std::runtime_error("it has other entities");
  space_.Apply(snapshot);
  changed_slots_.clear();
  last_ = state.Get<bool>();
  failed_ = state.Get<bool>();
  moved_ = state.GetArray<std::uint32_t>();
  for (const Functions& functions : functions_)
  {
    std::istringstream text(state.GetText());
    functions.object->LoadState(text);
  }
}

void SpaceServer::Advance(std::span<const EngineUpdate* const> updates,
                          std::span<const ControlCommands* const> commands)
{
  changed_slots_.clear();
  moved_.clear();
  for (const ControlCommands* command : commands) Merge(command->attributes);
  for (const EngineUpdate* update : updates)
  {
    space_.SetPoses(assignment_.engines[update->engine].owned, update->poses);
    Merge(update->attributes);
  }
  space_.SetTick(space_.GetTick() + 1);

  CallFunctions("PostStep", [this](const Functions& functions) { functions.object->PostStep(editor_); });
  AskWhetherFinished();
  if (!IsLast()) CallFunctions("PreStep", [this](const Functions& functions) { functions.object->PreStep(editor_); });
}

void SpaceServer::SetAttribute(std::uint32_t slot, double value)
{
  if (space_.Attributes()[slot] == value) return;
  space_.SetAttribute(slot, value);
  changed_slots_.push_back(slot);
}

void SpaceServer::Destroy()
{
  if (destroyed_) return;
  destroyed_ = true;
  CallFunctions("Destroy", [this](const Functions& functions) { functions.object->Destroy(editor_); });
}

template <class Call>
void SpaceServer::CallFunctions(const char* step, Call call)
{
  const std::uint64_t what = StreamName(std::string("functions ") + step);
  for (const Functions& functions : functions_)
  {
    editor_.BeginStep({experiment_.seed, StreamName(functions.configuration->id), what, space_.GetTick()});
    try
    {
      call(functions);
    }
    catch (const ConfigurationError&)
    {
      throw;
    }
    catch (const std::exception& error)
    {
      throw std::runtime_error("experiment functions '" + functions.configuration->id + "': " + step + " at tick " +
                               std::to_string(space_.GetTick()) + " failed: " + error.what());
    }
  }
}

void SpaceServer::AskWhetherFinished()
{
  CallFunctions("IsFinished",
                [this](const Functions& functions)
                {
                  const auto outcome = functions.object->IsFinished(editor_);
                  if (outcome == CExperimentFunctions::Outcome::kRunning) return;
                  last_ = true;
                  failed_ |= outcome == CExperimentFunctions::Outcome::kFailed;
                });
}

void SpaceServer::Move(const MoveRequest& request)
{
  space_.SetPose(request.entity, request.pose);
  moved_.push_back(request.entity);
}

void SpaceServer::Merge(const AttributeChanges& changes)
{
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    SetAttribute(changes.slots[k], changes.values[k]);
  }
}

}  // namespace swarmanoid
