// CRABMedium, which loop functions ask who hears whom.
#pragma once

#include <argos3/core/simulator/medium/medium.h>
#include <argos3/plugins/simulator/entities/rab_equipped_entity.h>

namespace argos
{

class CRABMedium : public CMedium
{
public:
  void AddEntity(CRABEquippedEntity&) {}
  void RemoveEntity(CRABEquippedEntity&) {}
  // Those whose messages a robot can receive where they stand now: of the same size, within their range, nobody
  // between. What a controller does not have a sensor range_and_bearing for is in none. It stays until asked for the
  // same robot again. Throws CARGoSException outside loop functions.
  const CRABEquippedEntity::TSet& GetRABsCommunicatingWith(CRABEquippedEntity& receiver) const;

private:
  mutable std::map<std::string, CRABEquippedEntity::TSet> heard_;
};

}  // namespace argos
