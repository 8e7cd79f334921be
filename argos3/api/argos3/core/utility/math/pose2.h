// CPose2: position and heading on the plane. It also converts from its frame to the frame around it.
#pragma once

#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CPose2
{
public:
  CPose2() = default;
  CPose2(const CVector2& position, const CRadians& orientation) : position_(position), orientation_(orientation) {}
  CPose2(Real x, Real y, Real radians) : CPose2(CVector2(x, y), CRadians(radians)) {}
  // Takes the heading of an upright body.
  CPose2(const CVector3& position, const CQuaternion& orientation) : position_(position.GetX(), position.GetY())
  {
    CVector3 axis;
    orientation.ToAngleAxis(orientation_, axis);
    orientation_ *= axis.GetZ();
  }

  const CVector2& GetPosition() const { return position_; }
  const CRadians& GetOrientation() const { return orientation_; }
  void Rotate(const CRadians& angle) { orientation_ += angle; }
  // `offset` is in its own frame.
  void Translate(const CVector2& offset) { position_ = *this * offset; }

  CPose2 Inverse() const { return {CVector2(-position_).Rotate(-orientation_), -orientation_}; }
  CPose2 operator*(const CPose2& other) const { return CPose2(*this) *= other; }
  CPose2& operator*=(const CPose2& other)
  {
    Translate(other.position_);
    Rotate(other.orientation_);
    orientation_.SignedNormalize();
    return *this;
  }
  // Returns a point of its frame in the frame around it.
  CVector2 operator*(const CVector2& point) const { return position_ + CVector2(point).Rotate(orientation_); }
  bool operator==(const CPose2& other) const
  {
    return position_ == other.position_ && orientation_ == other.orientation_;
  }
  bool operator!=(const CPose2& other) const { return !(*this == other); }

  friend std::ostream& operator<<(std::ostream& stream, const CPose2& pose)
  {
    return stream << "CPose2(" << pose.position_ << ", " << pose.orientation_ << ")";
  }

private:
  CVector2 position_;
  CRadians orientation_;
};

}  // namespace argos
