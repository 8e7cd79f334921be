// CVector2. In files it is "x,y". It can also be used as a matrix of one row or one column.
#pragma once

#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/matrix/matrix.h>

#include <array>
#include <cstring>

namespace argos
{

class CVector2
{
public:
  static const CVector2 X;
  static const CVector2 Y;
  static const CVector2 ZERO;

  constexpr CVector2() = default;
  constexpr CVector2(Real x, Real y) : x_(x), y_(y) {}
  template <class T>
  CVector2(const std::array<T, 2>& coordinates) : x_(coordinates[0]), y_(coordinates[1])
  {
  }
  CVector2(Real length, const CRadians& angle)
  {
    // Most readings of sensors are 0. Up to half a turn, the signs of sine and cosine are enough for them.
    const UInt64 length_bits = BitsOf(length);
    const UInt64 angle_bits = BitsOf(angle.GetValue());
    const UInt64 turn_bits = angle_bits & ~kSignBit;
    if ((length_bits & ~kSignBit) == 0 && turn_bits - 1 < kHalfTurnBits)
    {
      x_ = RealOf(length_bits ^ ((kQuarterTurnBits - turn_bits) & kSignBit));
      y_ = RealOf(length_bits ^ (angle_bits & kSignBit));
      return;
    }
    Real sine, cosine;
    SinCos(angle, sine, cosine);
    x_ = cosine * length;
    y_ = sine * length;
  }

  Real GetX() const { return x_; }
  Real GetY() const { return y_; }
  void SetX(Real x) { x_ = x; }
  void SetY(Real y) { y_ = y; }
  void Set(Real x, Real y)
  {
    x_ = x;
    y_ = y;
  }
  template <class T>
  void Set(const std::array<T, 2>& coordinates)
  {
    *this = CVector2(coordinates);
  }
  void FromPolarCoordinates(Real length, const CRadians& angle) { *this = CVector2(length, angle); }

  Real SquareLength() const { return x_ * x_ + y_ * y_; }
  Real Length() const { return std::sqrt(SquareLength()); }
  CRadians Angle() const { return ATan2(y_, x_); }
  CVector2& Normalize() { return *this /= Length(); }
  CVector2& Rotate(const CRadians& angle)
  {
    Real sine, cosine;
    SinCos(angle, sine, cosine);
    return *this = CVector2(x_ * cosine - y_ * sine, x_ * sine + y_ * cosine);
  }
  CVector2& Perpendicularize() { return *this = CVector2(-y_, x_); }
  CVector2& Absolute() { return *this = CVector2(Abs(x_), Abs(y_)); }
  CVector2& Scale(Real x, Real y) { return *this = CVector2(x_ * x, y_ * y); }
  Real DotProduct(const CVector2& other) const { return x_ * other.x_ + y_ * other.y_; }
  Real CrossProduct(const CVector2& other) const { return x_ * other.y_ - y_ * other.x_; }

  CVector2& operator+=(const CVector2& other) { return *this = CVector2(x_ + other.x_, y_ + other.y_); }
  CVector2& operator-=(const CVector2& other) { return *this = CVector2(x_ - other.x_, y_ - other.y_); }
  CVector2& operator*=(Real factor) { return *this = CVector2(x_ * factor, y_ * factor); }
  CVector2& operator/=(Real divisor) { return *this = CVector2(x_ / divisor, y_ / divisor); }
  friend CVector2 operator+(CVector2 a, const CVector2& b) { return a += b; }
  friend CVector2 operator-(CVector2 a, const CVector2& b) { return a -= b; }
  friend CVector2 operator*(CVector2 a, Real factor) { return a *= factor; }
  friend CVector2 operator*(Real factor, CVector2 a) { return a *= factor; }
  friend CVector2 operator/(CVector2 a, Real divisor) { return a /= divisor; }
  CVector2 operator-() const { return {-x_, -y_}; }
  bool operator==(const CVector2& other) const { return x_ == other.x_ && y_ == other.y_; }
  bool operator!=(const CVector2& other) const { return !(*this == other); }
  operator CMatrix<1, 2>() const { return CMatrix<1, 2>(Coordinates().data()); }
  operator CMatrix<2, 1>() const { return CMatrix<2, 1>(Coordinates().data()); }

  friend std::ostream& operator<<(std::ostream& stream, const CVector2& vector)
  {
    return stream << vector.x_ << "," << vector.y_;
  }
  friend std::istream& operator>>(std::istream& stream, CVector2& vector)
  {
    Real values[2]{};
    ParseValues<Real>(stream, 2, values, ',');
    vector.Set(values[0], values[1]);
    return stream;
  }

private:
  // The bits of numbers: absolute values are in the order of their bits.
  static constexpr UInt64 kSignBit = 0x8000000000000000;
  static constexpr UInt64 kHalfTurnBits = 0x400921fb54442d18;     // pi
  static constexpr UInt64 kQuarterTurnBits = 0x3ff921fb54442d18;  // pi / 2
  static UInt64 BitsOf(Real number)
  {
    UInt64 bits;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
  }
  static Real RealOf(UInt64 bits)
  {
    Real number;
    std::memcpy(&number, &bits, sizeof number);
    return number;
  }

  std::array<Real, 2> Coordinates() const { return {{x_, y_}}; }

  Real x_ = 0;
  Real y_ = 0;
};

inline const CVector2 CVector2::X{1, 0};
inline const CVector2 CVector2::Y{0, 1};
inline const CVector2 CVector2::ZERO{};

inline Real SquareDistance(const CVector2& a, const CVector2& b) { return (a - b).SquareLength(); }
inline Real Distance(const CVector2& a, const CVector2& b) { return (a - b).Length(); }

}  // namespace argos
