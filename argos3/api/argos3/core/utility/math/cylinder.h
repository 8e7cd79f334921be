// CCylinder: a cylinder on its base. The cylinder of an arena is CCylinderEntity.
#pragma once

#include <argos3/core/utility/math/ray3.h>

namespace argos
{

class CCylinder
{
public:
  // `position` is the middle of the base; `axis` has length 1.
  CCylinder(Real radius, Real height, const CVector3& position = CVector3(), const CVector3& axis = CVector3::Z)
      : radius_(radius), height_(height), position_(position), axis_(axis)
  {
  }
  Real GetRadius() const { return radius_; }
  void SetRadius(Real radius) { radius_ = radius; }
  Real GetHeight() const { return height_; }
  void SetHeight(Real height) { height_ = height; }
  const CVector3& GetBasePosition() const { return position_; }
  void SetBasePosition(const CVector3& position) { position_ = position; }
  const CVector3& GetAxis() const { return axis_; }
  void SetAxis(const CVector3& axis) { axis_ = axis; }

  // Returns the same as CBox::Intersects.
  bool Intersects(Real& t, const CRay3& ray) const
  {
    const CVector3 start = ray.GetStart() - position_;
    const CVector3 way = ray.GetEnd() - ray.GetStart();
    const Real height = start.DotProduct(axis_);
    const Real climb = way.DotProduct(axis_);
    Real first = -std::numeric_limits<Real>::infinity();
    Real last = std::numeric_limits<Real>::infinity();
    // The ray must be between the planes of base and top, and within the infinite cylinder.
    if (climb == 0 && (height < 0 || height > height_)) return false;
    if (climb != 0)
    {
      first = std::min(-height / climb, (height_ - height) / climb);
      last = std::max(-height / climb, (height_ - height) / climb);
    }
    const CVector3 from_axis = start - height * axis_;
    const CVector3 across = way - climb * axis_;
    const Real a = across.SquareLength();
    const Real b = across.DotProduct(from_axis);
    const Real c = from_axis.SquareLength() - radius_ * radius_;
    if (a == 0 && c > 0) return false;
    if (a > 0)
    {
      const Real square = b * b - a * c;
      if (square < 0) return false;
      first = std::max(first, (-b - Sqrt(square)) / a);
      last = std::min(last, (-b + Sqrt(square)) / a);
    }
    if (first > last || last < 0) return false;
    t = first >= 0 ? first : last;
    return true;
  }

private:
  Real radius_;
  Real height_;
  CVector3 position_;
  CVector3 axis_;
};

}  // namespace argos
