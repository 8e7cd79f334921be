// CPlane: a plane through a point.
#pragma once

#include <argos3/core/utility/math/vector3.h>

namespace argos
{

class CPlane
{
public:
  // The default is the floor.
  CPlane() : normal_(CVector3::Z) {}
  CPlane(const CVector3& position, const CVector3& normal) : position_(position), normal_(normal) {}
  const CVector3& GetPosition() const { return position_; }
  void SetPosition(const CVector3& position) { position_ = position; }
  const CVector3& GetNormal() const { return normal_; }
  void SetNormal(const CVector3& normal) { normal_ = normal; }

private:
  CVector3 position_;
  CVector3 normal_;
};

}  // namespace argos
