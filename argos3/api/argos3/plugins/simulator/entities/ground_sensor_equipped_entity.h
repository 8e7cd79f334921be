// The positions of a robot's simulated ground sensors. Loop functions can only read them.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CGroundSensorEquippedEntity : public CEntity
{
public:
  enum ESensorType
  {
    TYPE_BLACK_WHITE = 0,
    TYPE_GRAYSCALE
  };
  struct SSensor
  {
    CVector2 Offset;  // m, in the frame of the anchor
    ESensorType Type;
    SAnchor& Anchor;
    SSensor(const CVector2& offset, ESensorType type, SAnchor& anchor) : Offset(offset), Type(type), Anchor(anchor) {}
    using TList = std::vector<SSensor*>;
  };
  using TSensors = SSensor::TList;

  explicit CGroundSensorEquippedEntity(CEntity* parent, const std::string& id = "ground_0") : CEntity(parent, id) {}
  size_t GetNumSensors() const { return sensors_.size(); }
  // Throw CARGoSException for numbers from GetNumSensors() on.
  SSensor& GetSensor(size_t sensor);
  const SSensor& GetSensor(size_t sensor) const
  {
    return const_cast<CGroundSensorEquippedEntity*>(this)->GetSensor(sensor);
  }
  TSensors& GetSensors() { return sensors_; }
  std::string GetTypeDescription() const override { return "ground_sensors"; }

  // The arguments are as in CProximitySensorEquippedEntity.
  void Place(Real x, Real y, ESensorType type, SAnchor& anchor);

private:
  std::vector<std::shared_ptr<SSensor>> owned_;
  TSensors sensors_;
};

}  // namespace argos
