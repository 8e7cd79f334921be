// The eye-bot, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/plugins/simulator/entities/light_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/proximity_sensor_equipped_entity.h>

namespace argos
{

class CEyeBotEntity : public CRobotWithController
{
public:
  explicit CEyeBotEntity(const std::string& id) : CRobotWithController(id, kLeds) { AddParts(); }
  // The arguments are those of CFootBotEntity.
  CEyeBotEntity(const std::string& id, const std::string& controller, const CVector3& position = CVector3(),
                const CQuaternion& orientation = CQuaternion(), Real rab_range = 3, size_t rab_data_size = 10,
                const std::string& battery_model = "");
  CProximitySensorEquippedEntity& GetProximitySensorEquippedEntity() { return proximity_; }
  CLightSensorEquippedEntity& GetLightSensorEquippedEntity() { return light_; }
  std::string GetTypeDescription() const override { return "eye-bot"; }

private:
  void AddParts();

  CProximitySensorEquippedEntity proximity_{this};
  CLightSensorEquippedEntity light_{this};
  static constexpr unsigned kLeds = 16;
};

}  // namespace argos
