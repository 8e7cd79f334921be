// The e-puck, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/plugins/simulator/entities/ground_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/light_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/proximity_sensor_equipped_entity.h>

namespace argos
{

class CEPuckEntity : public CRobotWithController
{
public:
  // `leds`: eight, or eleven for e-pucks of argos3-epuck.
  explicit CEPuckEntity(const std::string& id, unsigned leds = kLeds) : CRobotWithController(id, leds) { AddParts(); }
  CWheeledEntity& GetWheeledEntity() { return wheels_; }
  CProximitySensorEquippedEntity& GetProximitySensorEquippedEntity() { return proximity_; }
  CLightSensorEquippedEntity& GetLightSensorEquippedEntity() { return light_; }
  CGroundSensorEquippedEntity& GetGroundSensorEquippedEntity() { return ground_; }
  // The arguments are those of CFootBotEntity.
  CEPuckEntity(const std::string& id, const std::string& controller, const CVector3& position = CVector3(),
               const CQuaternion& orientation = CQuaternion(), Real rab_range = 0.8, size_t rab_data_size = 2,
               const std::string& battery_model = "");
  std::string GetTypeDescription() const override { return "e-puck"; }

private:
  void AddParts();

  CWheeledEntity wheels_{this, 0.053, 0.0205};
  CProximitySensorEquippedEntity proximity_{this};
  CLightSensorEquippedEntity light_{this};
  CGroundSensorEquippedEntity ground_{this};
  static constexpr unsigned kLeds = 8;
};

}  // namespace argos
