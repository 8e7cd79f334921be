// CVector3. In files it is "x,y,z". It can also be used as a matrix of one row or one column.
#pragma once

#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CQuaternion;

class CVector3
{
public:
  static const CVector3 X;
  static const CVector3 Y;
  static const CVector3 Z;
  static const CVector3 ZERO;

  constexpr CVector3() = default;
  constexpr CVector3(Real x, Real y, Real z) : x_(x), y_(y), z_(z) {}
  template <class T>
  CVector3(const std::array<T, 3>& coordinates) : CVector3(coordinates[0], coordinates[1], coordinates[2])
  {
  }
  // Makes a vector from its length, its inclination from the z axis, and its azimuth.
  CVector3(Real length, const CRadians& inclination, const CRadians& azimuth)
  {
    FromSphericalCoords(length, inclination, azimuth);
  }

  Real GetX() const { return x_; }
  Real GetY() const { return y_; }
  Real GetZ() const { return z_; }
  void SetX(Real x) { x_ = x; }
  void SetY(Real y) { y_ = y; }
  void SetZ(Real z) { z_ = z; }
  // 0, 1 and 2 are x, y and z. Throws CARGoSException for other numbers.
  const Real& operator[](UInt32 axis) const
  {
    if (axis > 2) THROW_ARGOSEXCEPTION("a CVector3 has no element " << axis << "; the last one is 2");
    return axis == 0 ? x_ : axis == 1 ? y_ : z_;
  }
  Real& operator[](UInt32 axis) { return const_cast<Real&>(static_cast<const CVector3&>(*this)[axis]); }
  void Set(Real x, Real y, Real z) { *this = CVector3(x, y, z); }
  template <class T>
  void Set(const std::array<T, 3>& coordinates)
  {
    *this = CVector3(coordinates);
  }
  CVector3& FromSphericalCoords(Real length, const CRadians& inclination, const CRadians& azimuth)
  {
    const Real level = length * Sin(inclination);
    return *this = CVector3(level * Cos(azimuth), level * Sin(azimuth), length * Cos(inclination));
  }
  void ToSphericalCoords(Real& length, CRadians& inclination, CRadians& azimuth) const
  {
    length = Length();
    inclination = ACos(z_ / length);
    azimuth = ATan2(y_, x_);
  }

  Real SquareLength() const { return x_ * x_ + y_ * y_ + z_ * z_; }
  Real Length() const { return std::sqrt(SquareLength()); }
  CVector3& Normalize() { return *this /= Length(); }
  CVector3& Negate() { return *this = -*this; }
  CVector3& Absolute() { return *this = CVector3(Abs(x_), Abs(y_), Abs(z_)); }
  CVector3& Scale(Real x, Real y, Real z) { return *this = CVector3(x_ * x, y_ * y, z_ * z); }
  CVector3& RotateX(const CRadians& angle)
  {
    const CVector2 rotated = CVector2(y_, z_).Rotate(angle);
    return *this = CVector3(x_, rotated.GetX(), rotated.GetY());
  }
  CVector3& RotateY(const CRadians& angle)
  {
    const CVector2 rotated = CVector2(z_, x_).Rotate(angle);
    return *this = CVector3(rotated.GetY(), y_, rotated.GetX());
  }
  CVector3& RotateZ(const CRadians& angle)
  {
    const CVector2 rotated = CVector2(x_, y_).Rotate(angle);
    return *this = CVector3(rotated.GetX(), rotated.GetY(), z_);
  }
  // Rotates by the angle whose cosine and sine are x and y of `turn`.
  CVector3& RotateZ(const CVector2& turn)
  {
    return *this = CVector3(x_ * turn.GetX() - y_ * turn.GetY(), x_ * turn.GetY() + y_ * turn.GetX(), z_);
  }
  CVector3& Rotate(const CQuaternion& rotation);
  Real DotProduct(const CVector3& other) const { return x_ * other.x_ + y_ * other.y_ + z_ * other.z_; }
  // Replaces this vector by its product with the other one.
  CVector3& CrossProduct(const CVector3& other)
  {
    return *this =
               CVector3(y_ * other.z_ - z_ * other.y_, z_ * other.x_ - x_ * other.z_, x_ * other.y_ - y_ * other.x_);
  }
  CRadians GetAngleWith(const CVector3& other) const { return ACos(DotProduct(other) / (Length() * other.Length())); }
  CRadians GetXAngle() const { return ATan2(z_, y_); }
  CRadians GetYAngle() const { return ATan2(x_, z_); }
  CRadians GetZAngle() const { return ATan2(y_, x_); }
  CVector2& ProjectOntoXY(CVector2& projection) const { return projection = CVector2(x_, y_); }
  CVector2& ProjectOntoYZ(CVector2& projection) const { return projection = CVector2(y_, z_); }
  CVector2& ProjectOntoXZ(CVector2& projection) const { return projection = CVector2(x_, z_); }

  CVector3& operator+=(const CVector3& other) { return *this = CVector3(x_ + other.x_, y_ + other.y_, z_ + other.z_); }
  CVector3& operator-=(const CVector3& other) { return *this = CVector3(x_ - other.x_, y_ - other.y_, z_ - other.z_); }
  CVector3& operator*=(Real factor) { return *this = CVector3(x_ * factor, y_ * factor, z_ * factor); }
  CVector3& operator/=(Real divisor) { return *this = CVector3(x_ / divisor, y_ / divisor, z_ / divisor); }
  friend CVector3 operator+(CVector3 a, const CVector3& b) { return a += b; }
  friend CVector3 operator-(CVector3 a, const CVector3& b) { return a -= b; }
  friend CVector3 operator*(CVector3 a, Real factor) { return a *= factor; }
  friend CVector3 operator*(Real factor, CVector3 a) { return a *= factor; }
  friend CVector3 operator/(CVector3 a, Real divisor) { return a /= divisor; }
  CVector3 operator-() const { return {-x_, -y_, -z_}; }
  bool operator==(const CVector3& other) const { return x_ == other.x_ && y_ == other.y_ && z_ == other.z_; }
  bool operator!=(const CVector3& other) const { return !(*this == other); }
  operator CMatrix<1, 3>() const { return CMatrix<1, 3>(Coordinates().data()); }
  operator CMatrix<3, 1>() const { return CMatrix<3, 1>(Coordinates().data()); }
  // Compares each of the three.
  bool operator<(const CVector3& other) const { return x_ < other.x_ && y_ < other.y_ && z_ < other.z_; }
  bool operator>(const CVector3& other) const { return other < *this; }
  bool operator<=(const CVector3& other) const { return x_ <= other.x_ && y_ <= other.y_ && z_ <= other.z_; }
  bool operator>=(const CVector3& other) const { return other <= *this; }

  friend std::ostream& operator<<(std::ostream& stream, const CVector3& vector)
  {
    return stream << vector.x_ << "," << vector.y_ << "," << vector.z_;
  }
  friend std::istream& operator>>(std::istream& stream, CVector3& vector)
  {
    Real values[3]{};
    ParseValues<Real>(stream, 3, values, ',');
    vector.Set(values[0], values[1], values[2]);
    return stream;
  }

private:
  std::array<Real, 3> Coordinates() const { return {{x_, y_, z_}}; }

  Real x_ = 0;
  Real y_ = 0;
  Real z_ = 0;
};

inline const CVector3 CVector3::X{1, 0, 0};
inline const CVector3 CVector3::Y{0, 1, 0};
inline const CVector3 CVector3::Z{0, 0, 1};
inline const CVector3 CVector3::ZERO{};

inline Real SquareDistance(const CVector3& a, const CVector3& b) { return (a - b).SquareLength(); }
inline Real Distance(const CVector3& a, const CVector3& b) { return (a - b).Length(); }

}  // namespace argos
