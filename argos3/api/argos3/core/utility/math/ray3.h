// CRay3: a line from one point to another.
#pragma once

#include <argos3/core/utility/math/plane.h>
#include <argos3/core/utility/math/vector3.h>

namespace argos
{

class CRay3
{
public:
  CRay3() = default;
  CRay3(const CVector3& start, const CVector3& end) : start_(start), end_(end) {}
  CRay3(const CVector3& start, const CVector3& direction, Real length) { Set(start, direction, length); }

  CVector3& GetStart() { return start_; }
  const CVector3& GetStart() const { return start_; }
  CVector3& GetEnd() { return end_; }
  const CVector3& GetEnd() const { return end_; }
  void SetStart(const CVector3& start) { start_ = start; }
  void SetEnd(const CVector3& end) { end_ = end; }
  void Set(const CVector3& start, const CVector3& end) { *this = CRay3(start, end); }
  void Set(const CVector3& start, const CVector3& direction, Real length) { Set(start, start + length * direction); }

  void GetDirection(CVector3& direction) const { ToVector(direction).Normalize(); }
  void GetInverseDirection(CVector3& direction) const { direction = (start_ - end_).Normalize(); }
  Real GetLength() const { return (end_ - start_).Length(); }
  CVector3& ToVector(CVector3& vector) const { return vector = end_ - start_; }
  // `t` is 0 at the start and 1 at the end.
  void GetPoint(CVector3& point, Real t) const { point = start_ + t * (end_ - start_); }
  // Returns the distance from the start to the point at `t`.
  Real GetDistance(Real t) const { return Abs(t) * GetLength(); }
  // Returns whether it meets the plane, and where; a parallel ray does not.
  bool Intersects(const CPlane& plane, CVector3& point) const
  {
    CVector3 way;
    const Real along = plane.GetNormal().DotProduct(ToVector(way));
    const Real t = plane.GetNormal().DotProduct(plane.GetPosition() - start_) / along;
    if (along == 0 || t < 0 || t > 1) return false;
    GetPoint(point, t);
    return true;
  }

  friend std::ostream& operator<<(std::ostream& stream, const CRay3& ray)
  {
    return stream << ray.start_ << " -> " << ray.end_;
  }

private:
  CVector3 start_;
  CVector3 end_;
};

}  // namespace argos
