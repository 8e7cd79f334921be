// CQuaternion. In files and Euler angles, rotations have the order z, y, x: about the axis x, then about y of the
// rotated frame, then about its z.
#pragma once

#include <argos3/core/utility/math/vector3.h>

#include <array>

namespace argos
{

class CQuaternion
{
public:
  CQuaternion() = default;
  CQuaternion(Real w, Real x, Real y, Real z) : w_(w), v_(x, y, z) {}
  CQuaternion(const CRadians& angle, const CVector3& axis) { FromAngleAxis(angle, axis); }
  // Makes the shortest rotation from the direction of one vector to that of the other.
  CQuaternion(const CVector3& from, const CVector3& to) { BetweenTwoVectors(from, to); }

  Real GetW() const { return w_; }
  Real GetX() const { return v_.GetX(); }
  Real GetY() const { return v_.GetY(); }
  Real GetZ() const { return v_.GetZ(); }
  void SetW(Real w) { w_ = w; }
  void SetX(Real x) { v_.SetX(x); }
  void SetY(Real y) { v_.SetY(y); }
  void SetZ(Real z) { v_.SetZ(z); }
  void Set(Real w, Real x, Real y, Real z) { *this = CQuaternion(w, x, y, z); }

  CQuaternion Conjugate() const { return {w_, -v_}; }
  CQuaternion Inverse() const { return Conjugate(); }
  Real SquareLength() const { return w_ * w_ + v_.SquareLength(); }
  Real Length() const { return std::sqrt(SquareLength()); }
  CQuaternion& Normalize()
  {
    const Real length = Length();
    return *this = CQuaternion(w_ / length, v_ / length);
  }
  CQuaternion& FromAngleAxis(const CRadians& angle, const CVector3& axis)
  {
    return *this = CQuaternion(Cos(angle * 0.5), axis * Sin(angle * 0.5));
  }
  // The identity is returned as a rotation about the z axis.
  void ToAngleAxis(CRadians& angle, CVector3& axis) const
  {
    const Real sine = v_.Length();
    angle = sine > 0 ? ACos(w_) * 2 : CRadians::ZERO;
    axis = sine > 0 ? v_ / sine : CVector3::Z;
  }
  CQuaternion& FromEulerAngles(const CRadians& z, const CRadians& y, const CRadians& x)
  {
    return *this = CQuaternion(x, CVector3::X) * CQuaternion(y, CVector3::Y) * CQuaternion(z, CVector3::Z);
  }
  void ToEulerAngles(CRadians& z, CRadians& y, CRadians& x) const;
  CQuaternion& BetweenTwoVectors(const CVector3& from, const CVector3& to);

  CQuaternion& operator+=(const CQuaternion& q) { return *this = CQuaternion(w_ + q.w_, v_ + q.v_); }
  CQuaternion& operator-=(const CQuaternion& q) { return *this = CQuaternion(w_ - q.w_, v_ - q.v_); }
  CQuaternion& operator*=(const CQuaternion& q)
  {
    return *this =
               CQuaternion(w_ * q.w_ - v_.DotProduct(q.v_), q.v_ * w_ + v_ * q.w_ + CVector3(v_).CrossProduct(q.v_));
  }
  friend CQuaternion operator+(CQuaternion a, const CQuaternion& b) { return a += b; }
  friend CQuaternion operator-(CQuaternion a, const CQuaternion& b) { return a -= b; }
  friend CQuaternion operator*(CQuaternion a, const CQuaternion& b) { return a *= b; }
  bool operator==(const CQuaternion& other) const { return w_ == other.w_ && v_ == other.v_; }
  bool operator!=(const CQuaternion& other) const { return !(*this == other); }

  // Writes the Euler angles z, y, x in degrees.
  friend std::ostream& operator<<(std::ostream& stream, const CQuaternion& rotation)
  {
    CRadians z, y, x;
    rotation.ToEulerAngles(z, y, x);
    return stream << ToDegrees(z).GetValue() << "," << ToDegrees(y).GetValue() << "," << ToDegrees(x).GetValue();
  }
  friend std::istream& operator>>(std::istream& stream, CQuaternion& rotation)
  {
    Real degrees[3]{};
    ParseValues<Real>(stream, 3, degrees, ',');
    rotation.FromEulerAngles(ToRadians(CDegrees(degrees[0])), ToRadians(CDegrees(degrees[1])),
                             ToRadians(CDegrees(degrees[2])));
    return stream;
  }

private:
  CQuaternion(Real w, const CVector3& v) : w_(w), v_(v) {}

  Real w_ = 1;
  CVector3 v_;
};

inline void CQuaternion::ToEulerAngles(CRadians& z, CRadians& y, CRadians& x) const
{
  const auto [qx, qy, qz] = std::array<Real, 3>{GetX(), GetY(), GetZ()};
  const Real sine = 2 * (qx * qz + w_ * qy);
  // Near a quarter turn about y, the axes of x and z coincide: the whole remaining angle is returned as z.
  if (Abs(sine) > 0.998)
  {
    x = CRadians::ZERO;
    y = sine > 0 ? CRadians::PI_OVER_TWO : -CRadians::PI_OVER_TWO;
    z = ATan2(2 * (qx * qy + w_ * qz), 1 - 2 * (qx * qx + qz * qz));
    return;
  }
  x = ATan2(2 * (w_ * qx - qy * qz), w_ * w_ - qx * qx - qy * qy + qz * qz);
  y = ASin(sine);
  z = ATan2(2 * (w_ * qz - qx * qy), w_ * w_ + qx * qx - qy * qy - qz * qz);
}

inline CQuaternion& CQuaternion::BetweenTwoVectors(const CVector3& from, const CVector3& to)
{
  const Real lengths = std::sqrt(from.SquareLength() * to.SquareLength());
  const Real dot = from.DotProduct(to);
  if (dot > -0.999999 * lengths)
  {
    *this = CQuaternion(lengths + dot, CVector3(from).CrossProduct(to));
    return Normalize();
  }
  // The vectors are opposite: half a turn about any perpendicular axis is used.
  CVector3 axis = CVector3(from).CrossProduct(Abs(from.GetX()) < 0.9 * from.Length() ? CVector3::X : CVector3::Y);
  return FromAngleAxis(CRadians::PI, axis.Normalize());
}

inline CVector3& CVector3::Rotate(const CQuaternion& rotation)
{
  const CQuaternion rotated = rotation * CQuaternion(0, x_, y_, z_) * rotation.Conjugate();
  return *this = CVector3(rotated.GetX(), rotated.GetY(), rotated.GetZ());
}

}  // namespace argos
