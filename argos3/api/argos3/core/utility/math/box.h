// CBox: a box on its base, with any orientation. The box of an arena is CBoxEntity.
#pragma once

#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/ray3.h>

namespace argos
{

class CBox
{
public:
  // `position` is the middle of the base.
  CBox(const CVector3& size, const CVector3& position = CVector3(), const CQuaternion& orientation = CQuaternion())
      : size_(size), position_(position), orientation_(orientation)
  {
  }
  const CVector3& GetSize() const { return size_; }
  void SetSize(const CVector3& size) { size_ = size; }
  const CVector3& GetBasePosition() const { return position_; }
  void SetBasePosition(const CVector3& position) { position_ = position; }
  const CQuaternion& GetOrientation() const { return orientation_; }
  void SetOrientation(const CQuaternion& orientation) { orientation_ = orientation; }

  // Returns whether the line of the ray meets it from the start on. `t` is the first point, 1 at the end of the ray. If
  // the ray starts inside, `t` is where it leaves.
  bool Intersects(Real& t, const CRay3& ray) const
  {
    const CQuaternion back = orientation_.Inverse();
    const CVector3 start = (ray.GetStart() - position_).Rotate(back);
    const CVector3 way = (ray.GetEnd() - ray.GetStart()).Rotate(back);
    const CVector3 low(-size_.GetX() / 2, -size_.GetY() / 2, 0);
    Real first = -std::numeric_limits<Real>::infinity();
    Real last = std::numeric_limits<Real>::infinity();
    for (UInt32 i = 0; i < 3; ++i)
    {
      const Real high = low[i] + size_[i];
      if (way[i] == 0)
      {
        if (start[i] < low[i] || start[i] > high) return false;
        continue;
      }
      const Real in = (low[i] - start[i]) / way[i];
      const Real out = (high - start[i]) / way[i];
      first = std::max(first, std::min(in, out));
      last = std::min(last, std::max(in, out));
    }
    if (first > last || last < 0) return false;
    t = first >= 0 ? first : last;
    return true;
  }

private:
  CVector3 size_;
  CVector3 position_;
  CQuaternion orientation_;
};

}  // namespace argos
