// CPhysicsEngine: gives the length of a tick, and for loop functions the bodies that a ray meets. One engine has all
// bodies that ARGoS3's XML distributes over several.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>
#include <argos3/core/utility/math/ray3.h>
#include <argos3/core/utility/plugins/refused.h>

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

// Finds the bodies that a ray meets, each at its first point, nearest first. It clears the list first, and returns
// false if there are none. These functions throw CARGoSException outside loop functions.
bool GetEmbodiedEntitiesIntersectedByRay(TEmbodiedEntityIntersectionData& met, const CRay3& ray);
// Finds the nearest body; `met` has no entity if none exists. `ignored`: a body that the ray passes.
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
  // Returns the tick in s.
  static Real GetSimulationClockTick() { return tick_s_; }
  // Returns the ticks a second.
  static Real GetInverseSimulationClockTick() { return 1 / tick_s_; }
  // Sets the tick of the experiment, for the bridge.
  static void SetSimulationClockTick(Real tick_s) { tick_s_ = tick_s; }

private:
  static Real tick_s_;
  std::string id_ = "engine";  // changed to the last requested name
};

}  // namespace argos
