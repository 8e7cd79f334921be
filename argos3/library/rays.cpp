// Finds the bodies that a ray meets, for loop functions.
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/simulator/simulator.h>

#include <optional>

#include "argos3/library/editing.h"

namespace argos
{
namespace
{

using swarmanoid::SpaceQuery;
using swarmanoid::argos3::Editor;
using swarmanoid::argos3::TheRunning;

// Returns one entity of each engine, since queries for bodies need an observer in the engine's world.
std::vector<std::uint32_t> ObserverOfEachEngine()
{
  SpaceQuery& query = Editor().GetQuery();
  std::vector<std::uint32_t> observers;
  std::uint64_t known = 0;
  for (std::uint32_t i = 0; i < Editor().GetSpace().Size(); ++i)
  {
    if ((query.EnginesOf(i) & ~known) == 0) continue;
    known |= query.EnginesOf(i);
    observers.push_back(i);
  }
  return observers;
}

std::optional<SpaceQuery::Hit> Nearest(const CRay3& ray, const std::vector<std::uint32_t>& ignored)
{
  const auto& translation = TheRunning().translation;
  const swarmanoid::Vector3 from = translation.OurPosition(ray.GetStart());
  const swarmanoid::Vector3 to = translation.OurPosition(ray.GetEnd());
  std::optional<SpaceQuery::Hit> nearest;
  for (const std::uint32_t observer : ObserverOfEachEngine())
  {
    const auto hit = Editor().GetQuery().FindFirstHit(from, to, observer, ignored);
    if (hit && (!nearest || hit->fraction < nearest->fraction)) nearest = hit;
  }
  return nearest;
}

CEmbodiedEntity& BodyOf(std::uint32_t entity)
{
  const std::string& id = Editor().GetSpace().GetEntity(entity).GetId();
  if (auto* body = swarmanoid::argos3::TheirBodyOf(id)) return body->GetEmbodiedEntity();
  THROW_ARGOSEXCEPTION("a ray meets '" << id << "', which loop functions of ARGoS3 cannot see");
}

bool TellNearest(SEmbodiedEntityIntersectionItem& met, const CRay3& ray, const std::vector<std::uint32_t>& ignored)
{
  met = SEmbodiedEntityIntersectionItem();
  const auto hit = Nearest(ray, ignored);
  if (hit) met = {&BodyOf(hit->entity), hit->fraction};
  return hit.has_value();
}

}  // namespace

bool GetEmbodiedEntitiesIntersectedByRay(TEmbodiedEntityIntersectionData& met, const CRay3& ray)
{
  met.clear();
  std::vector<std::uint32_t> passed;
  while (const auto hit = Nearest(ray, passed))
  {
    met.emplace_back(&BodyOf(hit->entity), hit->fraction);
    passed.push_back(hit->entity);
  }
  return !met.empty();
}

bool GetClosestEmbodiedEntityIntersectedByRay(SEmbodiedEntityIntersectionItem& met, const CRay3& ray)
{
  return TellNearest(met, ray, {});
}

bool GetClosestEmbodiedEntityIntersectedByRay(SEmbodiedEntityIntersectionItem& met, const CRay3& ray,
                                              CEmbodiedEntity& ignored)
{
  return TellNearest(met, ray, {swarmanoid::argos3::Declared(ignored.GetRootEntity().GetId()).GetIndex()});
}

}  // namespace argos
