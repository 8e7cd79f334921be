// The Pi-Puck, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CPiPuckEntity : public CRobotWithController
{
public:
  explicit CPiPuckEntity(const std::string& id) : CRobotWithController(id, kLeds) {}
  std::string GetTypeDescription() const override { return "pipuck"; }

private:
  static constexpr unsigned kLeds = 10;
};

}  // namespace argos
