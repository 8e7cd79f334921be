// The positions of a robot's simulated light sensors. Loop functions can only read them.
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
    // The position in m, in the frame of the anchor.
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
  // Throw CARGoSException for numbers from GetNumSensors() on.
  SSensor& GetSensor(size_t sensor);
  const SSensor& GetSensor(size_t sensor) const
  {
    return const_cast<CLightSensorEquippedEntity*>(this)->GetSensor(sensor);
  }
  SSensor::TList& GetSensors() { return sensors_; }
  std::string GetTypeDescription() const override { return "light_sensors"; }

  // The arguments are as in CProximitySensorEquippedEntity.
  void PlaceRing(Real height, Real radius, const CRadians& first_angle, Real range, unsigned sensors, SAnchor& anchor);

private:
  std::vector<std::shared_ptr<SSensor>> owned_;
  SSensor::TList sensors_;
};

}  // namespace argos
