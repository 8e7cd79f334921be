#include "engine_worker/engine_worker.h"

#include <algorithm>
#include <array>

namespace swarmanoid
{

EngineWorker::EngineWorker(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t engine)
    : space_(space), layout_(assignment.engines[engine])
{
  const EngineConfiguration& configuration = space.GetExperiment().engines[engine];
  const auto* entry = PluginRegistry<CPhysicsEngine>::Instance().Find(configuration.tag);
  if (entry == nullptr)
    throw ConfigurationError(configuration.location, "no engine is registered as '" + configuration.tag + "'");
  engine_ = entry->create();
  engine_->Init({configuration, Parameters(configuration.tree, entry->description.parameters), space, layout_});
  for (const std::uint32_t index : configuration.entities)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(index);
    const bool owned = assignment.owner[index] == static_cast<int>(engine);
    const bool fixed = !entity.IsMovable() || IsBodiless(entity.GetKind());
    engine_->AddEntity(entity, fixed ? EBinding::kFixed : owned ? EBinding::kOwned : EBinding::kMirror);
  }
  engine_->Start();

  command_values_.resize(layout_.command_size);
  update_.engine = static_cast<std::uint32_t>(engine);
  update_.poses.resize(7 * layout_.owned.size());
  frame_.engine = static_cast<std::uint32_t>(engine);
  frame_.values.resize(layout_.sensor_size);
}

EngineWorker::~EngineWorker() = default;

void EngineWorker::Step(std::span<const std::uint32_t> moved, std::span<const ControlCommands* const> commands)
{
  for (const std::uint32_t entity : moved)
    if (std::binary_search(layout_.owned.begin(), layout_.owned.end(), entity)) engine_->EntityMoved(entity);

  for (const ValueCopy& copy : layout_.command_copies)
  {
    const auto source = std::find(layout_.commands_from.begin(), layout_.commands_from.end(), copy.source);
    const ControlCommands& message = *commands[static_cast<std::size_t>(source - layout_.commands_from.begin())];
    std::copy_n(message.values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                command_values_.begin() + static_cast<std::ptrdiff_t>(copy.to));
  }

  update_.tick = space_.GetTick() + 1;
  frame_.tick = update_.tick;
  update_.attributes.Clear();
  engine_->Update({layout_.commands, command_values_}, update_, frame_.values);
  order_.Apply(update_.attributes);
  KeepAbsent();
  if (update_.tick % space_.GetExperiment().canonical_period == 0) engine_->Canonicalise();
}

// Entities that are not in the arena stay where they wait, whatever the engine makes of them.
void EngineWorker::KeepAbsent()
{
  const PoseArrays& poses = space_.Poses();
  const std::array components{&poses.x, &poses.y, &poses.z, &poses.qx, &poses.qy, &poses.qz, &poses.qw};
  const std::size_t count = layout_.owned.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::uint32_t entity = layout_.owned[k];
    if (space_.IsPresent(entity)) continue;
    for (std::size_t c = 0; c < components.size(); ++c) update_.poses[c * count + k] = (*components[c])[entity];
  }
}

void EngineWorker::SaveState(ByteWriter& state) const
{
  state.PutArray(frame_.values);
  engine_->SaveState(state);
}

void EngineWorker::LoadState(ByteReader& state)
{
  frame_.values = state.GetArray<double>();
  if (frame_.values.size() != layout_.sensor_size) throw std::runtime_error("saved state: it is of another experiment");
  engine_->LoadState(state);
}

}  // namespace swarmanoid
