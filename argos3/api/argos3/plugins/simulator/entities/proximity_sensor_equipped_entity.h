// The positions of a robot's simulated proximity sensors. Loop functions can only read them.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CProximitySensorEquippedEntity : public CEntity
{
public:
  struct SSensor
  {
    // The position in m, in the frame of the anchor. The direction is as long as the range of the sensor.
    CVector3 Offset;
    CVector3 Direction;
    SAnchor& Anchor;
    SSensor(const CVector3& offset, const CVector3& direction, Real range, SAnchor& anchor)
        : Offset(offset), Direction(direction), Anchor(anchor)
    {
      Direction.Normalize();
      Direction *= range;
    }
    using TList = std::vector<SSensor*>;
  };
  using TSensors = SSensor::TList;

  explicit CProximitySensorEquippedEntity(CEntity* parent, const std::string& id = "proximity_0") : CEntity(parent, id)
  {
  }
  size_t GetNumSensors() const { return sensors_.size(); }
  // Throw CARGoSException for numbers from GetNumSensors() on.
  SSensor& GetSensor(size_t sensor);
  const SSensor& GetSensor(size_t sensor) const
  {
    return const_cast<CProximitySensorEquippedEntity*>(this)->GetSensor(sensor);
  }
  TSensors& GetSensors() { return sensors_; }
  std::string GetTypeDescription() const override { return "proximity_sensors"; }

  // Adds a sensor, for the robots of this library. Sensors added here do not change the simulated ones.
  void Place(const CVector3& offset, const CRadians& heading, Real range, SAnchor& anchor);
  void PlaceRing(Real height, Real radius, const CRadians& first_angle, Real range, unsigned sensors, SAnchor& anchor);

private:
  std::vector<std::shared_ptr<SSensor>> owned_;
  TSensors sensors_;
};

}  // namespace argos
