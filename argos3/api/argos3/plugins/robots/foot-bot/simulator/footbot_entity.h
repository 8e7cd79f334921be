// The foot-bot, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/plugins/simulator/entities/ground_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/light_sensor_equipped_entity.h>
#include <argos3/plugins/simulator/entities/proximity_sensor_equipped_entity.h>

namespace argos
{

class CFootBotEntity : public CRobotWithController
{
public:
  explicit CFootBotEntity(const std::string& id) : CRobotWithController(id, kLeds) { AddParts(); }
  CWheeledEntity& GetWheeledEntity() { return wheels_; }
  CProximitySensorEquippedEntity& GetProximitySensorEquippedEntity() { return proximity_; }
  CLightSensorEquippedEntity& GetLightSensorEquippedEntity() { return light_; }
  // Has the four sensors beside the motors, then the eight of the base.
  CGroundSensorEquippedEntity& GetGroundSensorEquippedEntity() { return ground_; }
  // Makes a foot-bot for AddEntity. `controller` is its id in the experiment file. The ranges and apertures are those
  // of the file's robots with the same controller; the values given here are ignored. The constructor is defined in the
  // library, since `swarmanoid` finds by its name which libraries make foot-bots.
  CFootBotEntity(const std::string& id, const std::string& controller, const CVector3& position = CVector3(),
                 const CQuaternion& orientation = CQuaternion(), Real rab_range = 3, size_t rab_data_size = 10,
                 const CRadians& omnidirectional_camera_aperture = CRadians(70 * ARGOS_PI / 180),
                 bool perspective_camera_front = true,
                 const CRadians& perspective_camera_aperture = CRadians(30 * ARGOS_PI / 180),
                 Real perspective_camera_focal_length = 0.035, Real perspective_camera_range = 2,
                 const std::string& battery_model = "");
  std::string GetTypeDescription() const override { return "foot-bot"; }

private:
  void AddParts();

  CWheeledEntity wheels_{this, 0.14, 0.029112741};
  CProximitySensorEquippedEntity proximity_{this};
  CLightSensorEquippedEntity light_{this};
  CGroundSensorEquippedEntity ground_{this};
  static constexpr unsigned kLeds = 13;  // the ring, and the beacon
};

}  // namespace argos
