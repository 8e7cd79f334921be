// The e-puck, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CEPuckEntity : public CRobotWithController
{
public:
  explicit CEPuckEntity(const std::string& id) : CRobotWithController(id, kLeds) { AddComponent(wheels_); }
  CWheeledEntity& GetWheeledEntity() { return wheels_; }
  // As that of CFootBotEntity.
  CEPuckEntity(const std::string& id, const std::string& controller, const CVector3& position = CVector3(),
               const CQuaternion& orientation = CQuaternion(), Real rab_range = 0.8, size_t rab_data_size = 2,
               const std::string& battery_model = "");
  std::string GetTypeDescription() const override { return "e-puck"; }

private:
  CWheeledEntity wheels_{this, 0.053, 0.0205};
  static constexpr unsigned kLeds = 8;
};

}  // namespace argos
