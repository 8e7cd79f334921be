// CPhysicsEngine: how long a tick is. One engine has all that an experiment in ARGoS3's XML gives to several. And what
// bodies a ray meets, for loop functions.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>
#include <argos3/core/utility/math/ray3.h>

#include <vector>

namespace argos
{

class CEmbodiedEntity;

struct SEmbodiedEntityIntersectionItem
{
  SEmbodiedEntityIntersectionItem() = default;
  SEmbodiedEntityIntersectionItem(CEmbodiedEntity* entity, Real t) : IntersectedEntity(entity), TOnRay(t) {}
  bool operator<(const SEmbodiedEntityIntersectionItem& other) const { return TOnRay < other.TOnRay; }

  CEmbodiedEntity* IntersectedEntity = nullptr;
  Real TOnRay = 1;  // 0 at the start of the ray, 1 at its end
};
using TEmbodiedEntityIntersectionData = std::vector<SEmbodiedEntityIntersectionItem>;

// The bodies that a ray meets, each where it comes first, the nearest one in front; the list is cleared before. False
// if there are none. These throw CARGoSException outside loop functions.
bool GetEmbodiedEntitiesIntersectedByRay(TEmbodiedEntityIntersectionData& met, const CRay3& ray);
// The nearest one; `met` has no entity if there is none. `ignored`: a body that the ray passes.
bool GetClosestEmbodiedEntityIntersectedByRay(SEmbodiedEntityIntersectionItem& met, const CRay3& ray);
bool GetClosestEmbodiedEntityIntersectedByRay(SEmbodiedEntityIntersectionItem& met, const CRay3& ray,
                                              CEmbodiedEntity& ignored);

class CPhysicsEngine
{
public:
  using TVector = std::vector<CPhysicsEngine*>;
  using TMap = std::map<std::string, CPhysicsEngine*>;

  const std::string& GetId() const { return id_; }
  void SetId(const std::string& id) { id_ = id; }
  // s
  static Real GetSimulationClockTick() { return tick_s_; }
  // Ticks a second.
  static Real GetInverseSimulationClockTick() { return 1 / tick_s_; }
  // For the bridge: of the experiment.
  static void SetSimulationClockTick(Real tick_s) { tick_s_ = tick_s; }

private:
  static Real tick_s_;
  std::string id_ = "engine";  // or the name by which it was asked for last
};

}  // namespace argos
