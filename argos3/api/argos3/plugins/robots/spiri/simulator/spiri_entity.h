// The Spiri, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CSpiriEntity : public CRobotWithController
{
public:
  explicit CSpiriEntity(const std::string& id) : CRobotWithController(id, kLeds) {}
  std::string GetTypeDescription() const override { return "spiri"; }

private:
  static constexpr unsigned kLeds = 0;
};

}  // namespace argos
