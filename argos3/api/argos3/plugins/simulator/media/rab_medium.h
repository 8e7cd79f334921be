// CRABMedium, from which loop functions read which robots hear each other.
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
  // Returns the robots whose messages a robot can receive at its present position: of the same size, within their
  // range, with no body between. Robots without a sensor range_and_bearing are in no list. The result is valid until
  // the next call for the same robot. Throws CARGoSException outside loop functions.
  const CRABEquippedEntity::TSet& GetRABsCommunicatingWith(CRABEquippedEntity& receiver) const;

private:
  mutable std::map<std::string, CRABEquippedEntity::TSet> heard_;
};

}  // namespace argos
