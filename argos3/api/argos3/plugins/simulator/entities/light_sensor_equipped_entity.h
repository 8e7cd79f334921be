// The light sensors of a robot: where the simulated ones are. Loop functions look at them and change none.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CLightSensorEquippedEntity : public CEntity
{
public:
  struct SSensor
  {
    // In the frame of the anchor, m.
    CVector3 Position;
    CVector3 Direction;
    SAnchor& Anchor;
    SSensor(const CVector3& position, const CVector3& direction, Real range, SAnchor& anchor)
        : Position(position), Direction(direction), Anchor(anchor)
    {
      Direction.Normalize();
      Direction *= range;
    }
    using TList = std::vector<SSensor*>;
  };

  explicit CLightSensorEquippedEntity(CEntity* parent, const std::string& id = "light_0") : CEntity(parent, id) {}
  size_t GetNumSensors() const { return sensors_.size(); }
  // Throw CARGoSException from GetNumSensors() on.
  SSensor& GetSensor(size_t sensor);
  const SSensor& GetSensor(size_t sensor) const
  {
    return const_cast<CLightSensorEquippedEntity*>(this)->GetSensor(sensor);
  }
  SSensor::TList& GetSensors() { return sensors_; }
  std::string GetTypeDescription() const override { return "light_sensors"; }

  // As that of CProximitySensorEquippedEntity.
  void PlaceRing(Real height, Real radius, const CRadians& first_angle, Real range, unsigned sensors, SAnchor& anchor);

private:
  std::vector<std::shared_ptr<SSensor>> owned_;
  SSensor::TList sensors_;
};

}  // namespace argos
