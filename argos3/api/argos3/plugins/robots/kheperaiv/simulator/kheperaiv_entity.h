// The Khepera IV, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/plugins/simulator/entities/ground_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/light_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/proximity_sensor_equipped_entity.h>

namespace argos
{

class CKheperaIVEntity : public CRobotWithController
{
public:
  explicit CKheperaIVEntity(const std::string& id) : CRobotWithController(id, kLeds) { AddParts(); }
  CWheeledEntity& GetWheeledEntity() { return wheels_; }
  CProximitySensorEquippedEntity& GetProximitySensorEquippedEntity() { return proximity_; }
  CProximitySensorEquippedEntity& GetUltrasoundSensorEquippedEntity() { return ultrasound_; }
  CLightSensorEquippedEntity& GetLightSensorEquippedEntity() { return light_; }
  CGroundSensorEquippedEntity& GetGroundSensorEquippedEntity() { return ground_; }
  // The arguments are those of CFootBotEntity.
  CKheperaIVEntity(const std::string& id, const std::string& controller, const CVector3& position = CVector3(),
                   const CQuaternion& orientation = CQuaternion(), Real rab_range = 3, size_t rab_data_size = 50,
                   const std::string& battery_model = "");
  std::string GetTypeDescription() const override { return "kheperaiv"; }

private:
  void AddParts();

  CWheeledEntity wheels_{this, 0.1054, 0.021};
  CProximitySensorEquippedEntity proximity_{this, "proximity"};
  CProximitySensorEquippedEntity ultrasound_{this, "ultrasound"};
  CLightSensorEquippedEntity light_{this};
  CGroundSensorEquippedEntity ground_{this};
  static constexpr unsigned kLeds = 3;
};

}  // namespace argos
