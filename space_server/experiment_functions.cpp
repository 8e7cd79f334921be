#include "space_server/experiment_functions.h"

#include <set>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/space/attributes.h"
#include "space_server/space_server.h"

namespace swarmanoid
{
namespace
{

CSwarmanoidSpaceEntity& FindOrThrow(CSwarmanoidSpace& space, std::string_view id)
{
  if (CSwarmanoidSpaceEntity* entity = space.FindEntity(id)) return *entity;
  throw std::invalid_argument("there is no entity '" + std::string(id) + "'");
}

void RequireRemovable(const CSwarmanoidSpaceEntity& entity)
{
  if (entity.IsMovable()) return;
  throw std::invalid_argument("the " + std::string(TagName(entity.GetKind())) + " '" + entity.GetId() +
                              "' never moves, so it cannot be added or removed; only robots, preys, movable blocks and "
                              "what is in a <reserve> can");
}

void RequirePresence(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity, bool present)
{
  if (space.IsPresent(entity.GetIndex()) == present) return;
  throw std::invalid_argument("entity '" + entity.GetId() +
                              (present ? "' is not in the arena" : "' is in the arena already"));
}

// The first entity of a reserve that is not in the arena.
const CSwarmanoidSpaceEntity* FirstWaiting(const CSwarmanoidSpace& space, std::string_view reserve)
{
  std::set<std::string> reserves;
  const CSwarmanoidSpaceEntity* last = nullptr;
  std::size_t quantity = 0;
  for (std::size_t i = 0; i < space.Size(); ++i)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(i);
    const std::string& of = entity.GetConfiguration().reserve;
    if (!of.empty()) reserves.insert(of);
    if (of != reserve) continue;
    if (!space.IsPresent(i)) return &entity;
    last = &entity;
    ++quantity;
  }
  if (last == nullptr)
    throw std::invalid_argument("there is no reserve and no entity '" + std::string(reserve) +
                                "'; reserves are: " + Listed({reserves.begin(), reserves.end()}));
  throw std::invalid_argument("all " + std::to_string(quantity) + " entities of the reserve '" + std::string(reserve) +
                              "' are in the arena; give its <reserve> (line " +
                              std::to_string(last->GetConfiguration().location.line) + ") a larger quantity");
}

}  // namespace

template <>
PluginRegistry<CExperimentFunctions>& PluginRegistry<CExperimentFunctions>::Instance()
{
  static PluginRegistry registry(PluginKind::kExperimentFunctions);
  return registry;
}

template class PluginRegistry<CExperimentFunctions>;

const CSwarmanoidSpace& SpaceEditor::GetSpace() const { return server_.Space(); }

SpaceQuery& SpaceEditor::GetQuery()
{
  if (query_ == nullptr) query_ = std::make_unique<SpaceQuery>(server_.Space());
  return *query_;
}

void SpaceEditor::MoveEntity(std::string_view id, const Pose& pose)
{
  const CSwarmanoidSpaceEntity& entity = FindOrThrow(server_.Space(), id);
  if (!entity.IsMovable()) throw std::invalid_argument("entity '" + std::string(id) + "' cannot move");
  RequirePresence(server_.Space(), entity, true);
  server_.Move({entity.GetIndex(), pose});
}

std::string SpaceEditor::AddEntity(std::string_view id, const Pose& pose)
{
  CSwarmanoidSpace& space = server_.Space();
  if (!pose.position.allFinite() || pose.position.x() < kWaitingBelow)
    throw std::invalid_argument("'" + std::string(id) + "' cannot be added there: it is outside all arenas");
  const CSwarmanoidSpaceEntity* added = space.FindEntity(id);
  if (added == nullptr)
    added = FirstWaiting(space, id);
  else
    RequireRemovable(*added);
  RequirePresence(space, *added, false);
  server_.Move({added->GetIndex(), pose});
  return added->GetId();
}

void SpaceEditor::RemoveEntity(std::string_view id)
{
  const CSwarmanoidSpaceEntity& entity = FindOrThrow(server_.Space(), id);
  RequireRemovable(entity);
  RequirePresence(server_.Space(), entity, true);
  server_.Move({entity.GetIndex(), WaitingPose(entity.GetConfiguration(), entity.GetIndex())});
}

void SpaceEditor::SetAttribute(std::string_view id, std::string_view attribute, double value, int element)
{
  const CSwarmanoidSpaceEntity& entity = FindOrThrow(server_.Space(), id);
  if (AttributeOffset(entity.GetKind(), attribute) < 0)
    throw std::invalid_argument("entity '" + std::string(id) + "' has no attribute '" + std::string(attribute) + "'");
  server_.SetAttribute(entity.SlotOf(attribute, element), value);
}

RandomStream SpaceEditor::GetRandom() const
{
  const CSwarmanoidSpace& space = GetSpace();
  return {space.GetExperiment().seed, 0, StreamName("experiment_functions"),
          static_cast<std::uint32_t>(space.GetTick())};
}

}  // namespace swarmanoid
