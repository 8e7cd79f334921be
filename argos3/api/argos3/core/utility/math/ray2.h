// CRay2: a line in the plane from one point to another.
#pragma once

#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CRay2
{
public:
  CRay2() = default;
  CRay2(const CVector2& start, const CVector2& end) : start_(start), end_(end) {}
  CRay2(const CVector2& start, const CVector2& direction, Real length) { Set(start, direction, length); }

  const CVector2& GetStart() const { return start_; }
  const CVector2& GetEnd() const { return end_; }
  void SetStart(const CVector2& start) { start_ = start; }
  void SetEnd(const CVector2& end) { end_ = end; }
  void Set(const CVector2& start, const CVector2& end) { *this = CRay2(start, end); }
  void Set(const CVector2& start, const CVector2& direction, Real length) { Set(start, start + length * direction); }

  void GetDirection(CVector2& direction) const { direction = (end_ - start_).Normalize(); }
  void GetInverseDirection(CVector2& direction) const { direction = (start_ - end_).Normalize(); }
  Real GetLength() const { return (end_ - start_).Length(); }
  void ToVector(CVector2& vector) const { vector = end_ - start_; }
  // `t` is 0 at the start and 1 at the end.
  void GetPoint(CVector2& point, Real t) const { point = start_ + t * (end_ - start_); }
  // Returns the distance from the start to the point at `t`.
  Real GetDistance(Real t) const { return Abs(t) * GetLength(); }
  // Returns whether the two cross or touch; parallel rays do not.
  bool Intersects(const CRay2& other) const
  {
    const CVector2 mine = end_ - start_;
    const CVector2 theirs = other.end_ - other.start_;
    const CVector2 between = other.start_ - start_;
    const Real across = mine.CrossProduct(theirs);
    if (Abs(across) < 1e-12 * Max<Real>(1, mine.Length() * theirs.Length())) return false;
    const CRange<Real> within(0, 1);
    return within.WithinMinBoundIncludedMaxBoundIncluded(between.CrossProduct(theirs) / across) &&
           within.WithinMinBoundIncludedMaxBoundIncluded(between.CrossProduct(mine) / across);
  }

  friend std::ostream& operator<<(std::ostream& stream, const CRay2& ray)
  {
    return stream << ray.start_ << " -> " << ray.end_;
  }

private:
  CVector2 start_;
  CVector2 end_;
};

}  // namespace argos
