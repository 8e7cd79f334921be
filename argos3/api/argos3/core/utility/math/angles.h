// CRadians and CDegrees, and their trigonometric functions.
#pragma once

#include <argos3/core/utility/math/general.h>
#include <argos3/core/utility/math/range.h>

#define ARGOS_PI 3.14159265358979323846264338327950288

namespace argos
{

// The common operations of both units.
template <class Angle>
class CAngle
{
public:
  constexpr CAngle() = default;
  constexpr explicit CAngle(Real value) : value_(value) {}

  constexpr Real GetValue() const { return value_; }
  constexpr Real GetAbsoluteValue() const { return value_ < 0 ? -value_ : value_; }
  void SetValue(Real value) { value_ = value; }
  Angle& Negate()
  {
    value_ = -value_;
    return Self();
  }

  constexpr Angle operator+() const { return Angle(value_); }
  constexpr Angle operator-() const { return Angle(-value_); }
  Angle& operator+=(const Angle& other)
  {
    value_ += other.value_;
    return Self();
  }
  Angle& operator-=(const Angle& other)
  {
    value_ -= other.value_;
    return Self();
  }
  Angle& operator*=(Real factor)
  {
    value_ *= factor;
    return Self();
  }
  Angle& operator/=(Real divisor)
  {
    value_ /= divisor;
    return Self();
  }
  friend constexpr Angle operator+(const Angle& a, const Angle& b) { return Angle(a.value_ + b.value_); }
  friend constexpr Angle operator-(const Angle& a, const Angle& b) { return Angle(a.value_ - b.value_); }
  friend constexpr Angle operator*(const Angle& a, Real factor) { return Angle(a.value_ * factor); }
  friend constexpr Angle operator*(Real factor, const Angle& a) { return Angle(a.value_ * factor); }
  friend constexpr Angle operator/(const Angle& a, Real divisor) { return Angle(a.value_ / divisor); }
  friend constexpr Real operator/(const Angle& a, const Angle& b) { return a.value_ / b.value_; }
  friend constexpr bool operator<(const Angle& a, const Angle& b) { return a.value_ < b.value_; }
  friend constexpr bool operator<=(const Angle& a, const Angle& b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>(const Angle& a, const Angle& b) { return a.value_ > b.value_; }
  friend constexpr bool operator>=(const Angle& a, const Angle& b) { return a.value_ >= b.value_; }
  friend constexpr bool operator==(const Angle& a, const Angle& b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(const Angle& a, const Angle& b) { return a.value_ != b.value_; }
  friend std::istream& operator>>(std::istream& stream, Angle& angle) { return stream >> angle.value_; }

private:
  Angle& Self() { return static_cast<Angle&>(*this); }
  Real value_ = 0;
};

class CRadians : public CAngle<CRadians>
{
public:
  using CAngle::CAngle;

  static const CRadians PI;
  static const CRadians TWO_PI;
  static const CRadians PI_OVER_TWO;
  static const CRadians PI_OVER_THREE;
  static const CRadians PI_OVER_FOUR;
  static const CRadians PI_OVER_SIX;
  static const CRadians ZERO;
  static const CRange<CRadians> SIGNED_RANGE;    // -pi to pi
  static const CRange<CRadians> UNSIGNED_RANGE;  // 0 to 2 pi
  static constexpr Real RADIANS_TO_DEGREES = 180.0 / ARGOS_PI;

  void FromValueInDegrees(Real degrees) { SetValue(degrees / RADIANS_TO_DEGREES); }
  CRadians& SignedNormalize();
  CRadians& UnsignedNormalize();

  friend std::ostream& operator<<(std::ostream& stream, const CRadians& angle)
  {
    return stream << "CRadians(" << angle.GetValue() << " -> " << angle.GetValue() * RADIANS_TO_DEGREES << " degrees)";
  }
};

inline const CRadians CRadians::PI{ARGOS_PI};
inline const CRadians CRadians::TWO_PI{2 * ARGOS_PI};
inline const CRadians CRadians::PI_OVER_TWO{ARGOS_PI / 2};
inline const CRadians CRadians::PI_OVER_THREE{ARGOS_PI / 3};
inline const CRadians CRadians::PI_OVER_FOUR{ARGOS_PI / 4};
inline const CRadians CRadians::PI_OVER_SIX{ARGOS_PI / 6};
inline const CRadians CRadians::ZERO{0};
inline const CRange<CRadians> CRadians::SIGNED_RANGE{CRadians(-ARGOS_PI), CRadians(ARGOS_PI)};
inline const CRange<CRadians> CRadians::UNSIGNED_RANGE{CRadians(0), CRadians(2 * ARGOS_PI)};

inline CRadians& CRadians::SignedNormalize()
{
  SIGNED_RANGE.WrapValue(*this);
  return *this;
}
inline CRadians& CRadians::UnsignedNormalize()
{
  UNSIGNED_RANGE.WrapValue(*this);
  return *this;
}

class CDegrees : public CAngle<CDegrees>
{
public:
  using CAngle::CAngle;
  static constexpr Real DEGREES_TO_RADIANS = ARGOS_PI / 180.0;

  void FromValueInRadians(Real radians) { SetValue(radians / DEGREES_TO_RADIANS); }
  CDegrees& SignedNormalize()
  {
    CRange<CDegrees>(CDegrees(-180), CDegrees(180)).WrapValue(*this);
    return *this;
  }
  CDegrees& UnsignedNormalize()
  {
    CRange<CDegrees>(CDegrees(0), CDegrees(360)).WrapValue(*this);
    return *this;
  }

  friend std::ostream& operator<<(std::ostream& stream, const CDegrees& angle)
  {
    return stream << "CDegrees(" << angle.GetValue() << ")";
  }
};

constexpr CDegrees ToDegrees(const CRadians& angle)
{
  return CDegrees(angle.GetValue() * CRadians::RADIANS_TO_DEGREES);
}
constexpr CRadians ToRadians(const CDegrees& angle)
{
  return CRadians(angle.GetValue() * CDegrees::DEGREES_TO_RADIANS);
}

// Returns a - b, within half a turn.
inline CRadians NormalizedDifference(const CRadians& a, const CRadians& b) { return (a - b).SignedNormalize(); }
inline CDegrees NormalizedDifference(const CDegrees& a, const CDegrees& b) { return (a - b).SignedNormalize(); }

// Computes both at once. Sin and Cos give the same bits.
void SinCos(const CRadians& angle, Real& sine, Real& cosine);
inline Real Sin(const CRadians& angle)
{
  Real sine, cosine;
  SinCos(angle, sine, cosine);
  return sine;
}
inline Real Cos(const CRadians& angle)
{
  Real sine, cosine;
  SinCos(angle, sine, cosine);
  return cosine;
}
inline Real Tan(const CRadians& angle) { return std::tan(angle.GetValue()); }
inline CRadians ASin(Real value) { return CRadians(std::asin(value)); }
inline CRadians ACos(Real value) { return CRadians(std::acos(value)); }
inline CRadians ATan2(Real y, Real x) { return CRadians(std::atan2(y, x)); }
inline CRadians ATan(Real value) { return CRadians(std::atan(value)); }

}  // namespace argos
