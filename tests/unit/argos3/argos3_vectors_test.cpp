// Angles, ranges, vectors, quaternions and rays of ARGoS3, beside Eigen and closed forms.
#include <argos3/core/utility/math/box.h>
#include <argos3/core/utility/math/cylinder.h>
#include <argos3/core/utility/math/pose2.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/ray2.h>
#include <argos3/core/utility/math/ray3.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

namespace
{

using namespace argos;

constexpr double kNearly = 1e-12;
constexpr double kHalfTurn = std::numbers::pi;

template <class Value>
Value ReadFrom(const std::string& text)
{
  std::istringstream stream(text);
  Value value;
  stream >> value;
  return value;
}

template <class Angle>
void ExpectArithmeticOfAngles()
{
  const Angle three(3), minus_two(-2);
  EXPECT_EQ(Angle().GetValue(), 0);
  EXPECT_EQ(minus_two.GetAbsoluteValue(), 2);
  EXPECT_EQ(three.GetAbsoluteValue(), 3);
  EXPECT_EQ((+three).GetValue(), 3);
  EXPECT_EQ((-three).GetValue(), -3);
  EXPECT_EQ((three + minus_two).GetValue(), 1);
  EXPECT_EQ((three - minus_two).GetValue(), 5);
  EXPECT_EQ((three * 4).GetValue(), 12);
  EXPECT_EQ((4 * three).GetValue(), 12);
  EXPECT_EQ((three / 4).GetValue(), 0.75);
  EXPECT_EQ(three / minus_two, -1.5);
  Angle angle(5);
  EXPECT_EQ((angle += three).GetValue(), 8);
  EXPECT_EQ((angle -= minus_two).GetValue(), 10);
  EXPECT_EQ((angle *= 3).GetValue(), 30);
  EXPECT_EQ((angle /= 4).GetValue(), 7.5);
  EXPECT_EQ(angle.Negate().GetValue(), -7.5);
  angle.SetValue(3);
  EXPECT_TRUE(angle == three && angle <= three && angle >= three);
  EXPECT_FALSE(angle != three || angle < three || angle > three);
  EXPECT_TRUE(minus_two < three && minus_two <= three && three > minus_two && three >= minus_two && three != minus_two);
  EXPECT_FALSE(three < minus_two || three <= minus_two || minus_two > three || minus_two >= three ||
               three == minus_two);
  EXPECT_EQ(ReadFrom<Angle>("-0.5").GetValue(), -0.5);
}

TEST(Argos3Vectors, AnglesAreNumbersWithAUnit)
{
  ExpectArithmeticOfAngles<CRadians>();
  ExpectArithmeticOfAngles<CDegrees>();
  EXPECT_EQ(ToString(CDegrees(30)), "CDegrees(30)");
  EXPECT_EQ(ToString(CRadians(0)), "CRadians(0 -> 0 degrees)");
  EXPECT_DOUBLE_EQ(ToDegrees(CRadians(kHalfTurn)).GetValue(), 180);
  EXPECT_DOUBLE_EQ(ToRadians(CDegrees(90)).GetValue(), kHalfTurn / 2);
  CRadians radians;
  radians.FromValueInDegrees(45);
  EXPECT_DOUBLE_EQ(radians.GetValue(), kHalfTurn / 4);
  CDegrees degrees;
  degrees.FromValueInRadians(kHalfTurn / 3);
  EXPECT_DOUBLE_EQ(degrees.GetValue(), 60);
  EXPECT_EQ(CRadians::ZERO.GetValue(), 0);
  EXPECT_DOUBLE_EQ(CRadians::SIGNED_RANGE.GetMin().GetValue(), -kHalfTurn);
  EXPECT_DOUBLE_EQ(CRadians::SIGNED_RANGE.GetMax().GetValue(), kHalfTurn);
  EXPECT_EQ(CRadians::UNSIGNED_RANGE.GetMin().GetValue(), 0);
  EXPECT_DOUBLE_EQ(CRadians::UNSIGNED_RANGE.GetMax().GetValue(), 2 * kHalfTurn);
}

TEST(Argos3Vectors, NormalizedAnglesDifferByWholeTurns)
{
  for (double degrees = -1000; degrees <= 1000; degrees += 13)
  {
    for (CDegrees normalized : {CDegrees(degrees).SignedNormalize(), CDegrees(degrees).UnsignedNormalize()})
      EXPECT_NEAR(std::remainder(normalized.GetValue() - degrees, 360), 0, 1e-9) << degrees;
    EXPECT_LE(CDegrees(degrees).SignedNormalize().GetAbsoluteValue(), 180);
    CRadians radians = ToRadians(CDegrees(degrees));
    radians.UnsignedNormalize();
    EXPECT_GE(radians.GetValue(), 0);
    EXPECT_LE(radians.GetValue(), 2 * kHalfTurn);
    EXPECT_NEAR(std::cos(radians.GetValue()), std::cos(degrees * kHalfTurn / 180), 1e-9);
  }
  EXPECT_NEAR(NormalizedDifference(CDegrees(170), CDegrees(-170)).GetValue(), -20, kNearly);
  EXPECT_NEAR(NormalizedDifference(CDegrees(-170), CDegrees(170)).GetValue(), 20, kNearly);
  EXPECT_NEAR(NormalizedDifference(CDegrees(30), CDegrees(10)).GetValue(), 20, kNearly);
}

TEST(Argos3Vectors, FunctionsOfAnglesAreThoseOfMathematics)
{
  for (double value = -7; value < 7; value += 0.37)
  {
    const CRadians angle(value);
    EXPECT_NEAR(Sin(angle), std::sin(value), kNearly);
    EXPECT_NEAR(Cos(angle), std::cos(value), kNearly);
    EXPECT_NEAR(Tan(angle), std::tan(value), 1e-9);
    EXPECT_NEAR(ATan(value).GetValue(), std::atan(value), kNearly);
    EXPECT_NEAR(ATan2(value, -0.5).GetValue(), std::atan2(value, -0.5), kNearly);
    EXPECT_NEAR(ASin(value / 7).GetValue(), std::asin(value / 7), kNearly);
    EXPECT_NEAR(ACos(value / 7).GetValue(), std::acos(value / 7), kNearly);
  }
}

TEST(Argos3Vectors, ElementaryFunctionsOfNumbers)
{
  EXPECT_EQ(Abs(-3), 3);
  EXPECT_EQ(Abs(2.5), 2.5);
  EXPECT_EQ(Abs(CRadians(-1)), CRadians(1));
  int small = 1, large = 2;
  EXPECT_EQ(Min(small, large), 1);
  EXPECT_EQ(Min(large, small), 1);
  EXPECT_EQ(Max(small, large), 2);
  EXPECT_EQ(Max(large, small), 2);
  EXPECT_EQ(Min(3.5, 2.5) * 10 + Max(3.5, 2.5), 28.5);
  Min(small, large) = 7;
  EXPECT_EQ(small, 7) << "a reference to the smaller one";
  Max(small, large) = 9;
  EXPECT_EQ(small, 9);
  EXPECT_EQ(Sign(-0.5), -1);
  EXPECT_EQ(Sign(0.0), 0);
  EXPECT_EQ(Sign(0.5), 1);
  EXPECT_EQ(Square(-3), 9);
  EXPECT_DOUBLE_EQ(Log(std::numbers::e), 1);
  EXPECT_EQ(Sqrt(6.25), 2.5);
  EXPECT_DOUBLE_EQ(Exp(1), std::numbers::e);
  EXPECT_DOUBLE_EQ(Mod(7.5, 2), 1.5);
  // The rows are the argument, Floor, Ceil, RoundClosestToZero and Round.
  const double rows[][5] = {{2.4, 2, 3, 2, 2},      {2.5, 2, 3, 2, 3},      {2, 2, 2, 2, 2},   {0, 0, 0, 0, 0},
                            {-2.4, -3, -2, -2, -2}, {-2.6, -3, -2, -2, -3}, {0.7, 0, 1, 0, 1}, {-0.7, -1, 0, 0, -1}};
  for (const auto& row : rows)
  {
    EXPECT_EQ(Floor(row[0]), row[1]) << row[0];
    EXPECT_EQ(Ceil(row[0]), row[2]) << row[0];
    EXPECT_EQ(RoundClosestToZero(row[0]), row[3]) << row[0];
    EXPECT_EQ(Round(row[0]), row[4]) << row[0];
  }
  EXPECT_EQ(Floor(-2), -3) << "as in ARGoS3";
  EXPECT_TRUE(DoubleEqAbsolute(0.1, 0.35, 0.25));
  EXPECT_FALSE(DoubleEqAbsolute(0.1, 0.36, 0.25));
  EXPECT_TRUE(DoubleEqAbsolute(100, 124, 0.25)) << "relative to numbers above 1";
  EXPECT_TRUE(DoubleEqAbsolute(-124, -100, 0.25));
  EXPECT_FALSE(DoubleEqAbsolute(100, 140, 0.25));
  EXPECT_TRUE(DoubleEq(1, 1.00009));
  EXPECT_FALSE(DoubleEq(1, 1.0002));
  const std::vector<std::pair<Real, Real>> points{{0, 1}, {1, 3}, {3, -1}};
  const double values[][2] = {{0, 1}, {0.5, 2}, {1, 3}, {2, 1}, {3, -1}, {-1, -1}, {4, -3}};
  for (const auto& [x, y] : values) EXPECT_NEAR(Interpolate(x, points), y, kNearly) << x;
  EXPECT_NEAR(Interpolate(7, {{1, 2}, {2, 4}}), 14, kNearly);
}

TEST(Argos3Vectors, RangesIncludeTheirEndsOrDoNot)
{
  const CRange<Real> range(-1, 3);
  EXPECT_EQ(range.GetSpan(), 4);
  // The columns are whether a value is within: both ends included, the first, the second, none.
  const std::pair<double, std::array<bool, 4>> rows[] = {{-1.5, {false, false, false, false}},
                                                         {-1, {true, true, false, false}},
                                                         {0, {true, true, true, true}},
                                                         {3, {true, false, true, false}},
                                                         {3.5, {false, false, false, false}}};
  for (const auto& [value, within] : rows)
  {
    EXPECT_EQ(range.WithinMinBoundIncludedMaxBoundIncluded(value), within[0]) << value;
    EXPECT_EQ(range.WithinMinBoundIncludedMaxBoundExcluded(value), within[1]) << value;
    EXPECT_EQ(range.WithinMinBoundExcludedMaxBoundIncluded(value), within[2]) << value;
    EXPECT_EQ(range.WithinMinBoundExcludedMaxBoundExcluded(value), within[3]) << value;
  }
  const double cut[][3] = {{-2, -1, 0}, {-1, -1, 0}, {0, 0, 0.25}, {3, 3, 1}, {4, 3, 1}};
  for (const auto& [value, limited, part] : cut)
  {
    Real truncated = value;
    range.TruncValue(truncated);
    EXPECT_EQ(truncated, limited);
    EXPECT_EQ(range.NormalizeValue(value), part);
    Real mapped = 0;
    range.MapValueIntoRange(mapped, value, CRange<Real>(10, 30));
    EXPECT_EQ(mapped, 10 + 20 * part);
  }
  const double turns[][2] = {{5, 1}, {-2, 2}, {3, 3}, {-1, -1}, {12.5, 0.5}, {-9, -1}};
  for (const auto& [value, wrapped] : turns)
  {
    Real changed = value;
    range.WrapValue(changed);
    EXPECT_EQ(changed, wrapped) << value;
  }
  CRange<SInt32> whole(1, 4);
  whole.SetMin(4);
  EXPECT_EQ(whole.GetSpan(), 0) << "a range of one number";
  EXPECT_THROW(whole.SetMax(3), CARGoSException);
  EXPECT_THROW(whole.SetMin(5), CARGoSException);
  EXPECT_EQ(ToString(whole), "4:4") << "a refused change changes nothing";
  whole.SetMax(6);
  EXPECT_EQ(whole.GetMin() * 10 + whole.GetMax(), 46);
  const auto read = ReadFrom<CRange<Real>>("-2.5:7");
  EXPECT_EQ(read.GetMin(), -2.5);
  EXPECT_EQ(read.GetMax(), 7);
  EXPECT_THROW(ReadFrom<CRange<Real>>("7:-2.5"), CARGoSException);
  EXPECT_THROW(ReadFrom<CRange<Real>>("7"), CARGoSException);
  EXPECT_EQ(CRange<Real>().GetMin(), 0);
  EXPECT_EQ(CRange<Real>().GetMax(), 0);
}

TEST(Argos3Vectors, VectorsOfThePlane)
{
  CVector2 vector(3, -4);
  EXPECT_EQ(vector.SquareLength(), 25);
  EXPECT_EQ(vector.Length(), 5);
  EXPECT_DOUBLE_EQ(vector.Angle().GetValue(), std::atan2(-4, 3));
  EXPECT_EQ(vector.DotProduct(CVector2(2, 1)), 2);
  EXPECT_EQ(vector.CrossProduct(CVector2(2, 1)), 11);
  EXPECT_EQ(vector + CVector2(1, 2), CVector2(4, -2));
  EXPECT_EQ(vector - CVector2(1, 2), CVector2(2, -6));
  EXPECT_EQ(vector * 2, CVector2(6, -8));
  EXPECT_EQ(2 * vector, CVector2(6, -8));
  EXPECT_EQ(vector / 2, CVector2(1.5, -2));
  EXPECT_EQ(-vector, CVector2(-3, 4));
  EXPECT_EQ(CVector2(vector).Perpendicularize(), CVector2(4, 3));
  EXPECT_EQ(CVector2(vector).Absolute(), CVector2(3, 4));
  EXPECT_EQ(CVector2(-3, 4).Absolute(), CVector2(3, 4));
  EXPECT_EQ(CVector2(vector).Scale(2, 3), CVector2(6, -12));
  EXPECT_LT(Distance(CVector2(vector).Normalize(), CVector2(0.6, -0.8)), kNearly);
  EXPECT_LT(Distance(CVector2(vector).Rotate(CRadians::PI_OVER_TWO), CVector2(4, 3)), kNearly);
  EXPECT_EQ(SquareDistance(CVector2(1, 2), CVector2(4, 6)), 25);
  EXPECT_EQ(Distance(CVector2(1, 2), CVector2(4, 6)), 5);
  vector += CVector2(1, 1);
  vector -= CVector2(2, 3);
  vector *= 3;
  vector /= 2;
  EXPECT_EQ(vector, CVector2(3, -9));
  vector.SetX(8);
  vector.SetY(9);
  EXPECT_EQ(ToString(vector), "8,9");
  vector.Set(1, 2);
  EXPECT_EQ(vector, CVector2(1, 2));
  vector.Set(std::array<int, 2>{5, 6});
  EXPECT_EQ(vector, CVector2(std::array<int, 2>{5, 6}));
  EXPECT_EQ(vector.GetX() * 10 + vector.GetY(), 56);
  vector.FromPolarCoordinates(2, CRadians::PI_OVER_SIX);
  EXPECT_LT(Distance(vector, CVector2(std::sqrt(3), 1)), kNearly);
  EXPECT_EQ(ReadFrom<CVector2>("-1.5,2"), CVector2(-1.5, 2));
  EXPECT_THROW(ReadFrom<CVector2>("1"), CARGoSException);
  EXPECT_EQ(CVector2::X, CVector2(1, 0));
  EXPECT_EQ(CVector2::Y, CVector2(0, 1));
  EXPECT_EQ(CVector2::ZERO, CVector2());
  EXPECT_EQ(CVector2(), CVector2(0, 0));
  const CMatrix<1, 2> row = CVector2(1, 2);
  EXPECT_EQ(row(0, 0) * 10 + row(0, 1), 12);
}

TEST(Argos3Vectors, VectorsOfSpace)
{
  CVector3 vector(2, -3, 6);
  EXPECT_EQ(vector.SquareLength(), 49);
  EXPECT_EQ(vector.Length(), 7);
  EXPECT_EQ(vector.DotProduct(CVector3(1, 2, 3)), 14);
  EXPECT_EQ(CVector3(vector).CrossProduct(CVector3(1, 2, 3)), CVector3(-21, 0, 7));
  EXPECT_EQ(vector + CVector3(1, 2, 3), CVector3(3, -1, 9));
  EXPECT_EQ(vector - CVector3(1, 2, 3), CVector3(1, -5, 3));
  EXPECT_EQ(vector * 2, CVector3(4, -6, 12));
  EXPECT_EQ(2 * vector, CVector3(4, -6, 12));
  EXPECT_EQ(vector / 2, CVector3(1, -1.5, 3));
  EXPECT_EQ(-vector, CVector3(-2, 3, -6));
  EXPECT_EQ(CVector3(vector).Negate(), CVector3(-2, 3, -6));
  EXPECT_EQ(CVector3(vector).Absolute(), CVector3(2, 3, 6));
  EXPECT_EQ(CVector3(-2, 3, -6).Absolute(), CVector3(2, 3, 6));
  EXPECT_EQ(CVector3(vector).Scale(2, 3, 4), CVector3(4, -9, 24));
  EXPECT_LT(Distance(CVector3(vector).Normalize(), CVector3(2. / 7, -3. / 7, 6. / 7)), kNearly);
  EXPECT_EQ(SquareDistance(CVector3(1, 1, 1), CVector3(3, -2, 7)), 49);
  EXPECT_EQ(Distance(CVector3(1, 1, 1), CVector3(3, -2, 7)), 7);
  vector += CVector3(1, 1, 1);
  vector -= CVector3(2, 3, 4);
  vector *= 3;
  vector /= 2;
  EXPECT_EQ(vector, CVector3(1.5, -7.5, 4.5));
  vector.SetX(7);
  vector.SetY(8);
  vector.SetZ(9);
  EXPECT_EQ(ToString(vector), "7,8,9");
  EXPECT_EQ(vector.GetX() * 100 + vector.GetY() * 10 + vector.GetZ(), 789);
  vector.Set(std::array<int, 3>{4, 5, 6});
  EXPECT_EQ(vector, CVector3(4, 5, 6));
  vector.Set(1, 2, 3);
  EXPECT_EQ(vector, CVector3(1, 2, 3));
  EXPECT_EQ(ReadFrom<CVector3>("-1.5,2,0.25"), CVector3(-1.5, 2, 0.25));
  EXPECT_THROW(ReadFrom<CVector3>("1,2"), CARGoSException);
  EXPECT_EQ(CVector3::X, CVector3(1, 0, 0));
  EXPECT_EQ(CVector3::Y, CVector3(0, 1, 0));
  EXPECT_EQ(CVector3::Z, CVector3(0, 0, 1));
  EXPECT_EQ(CVector3::ZERO, CVector3(0, 0, 0));
  CVector2 shadow;
  EXPECT_EQ(vector.ProjectOntoXY(shadow), CVector2(1, 2));
  EXPECT_EQ(vector.ProjectOntoXZ(shadow), CVector2(1, 3));
  EXPECT_EQ(shadow, CVector2(1, 3));
  const CMatrix<1, 3> row = vector;
  EXPECT_EQ(row(0, 0) * 100 + row(0, 1) * 10 + row(0, 2), 123);
  EXPECT_NEAR(CVector3(2, 0, 0).GetAngleWith(CVector3(1, 1, 0)).GetValue(), kHalfTurn / 4, kNearly);
  EXPECT_NEAR(CVector3(9, 2, 1).GetXAngle().GetValue(), std::atan2(1, 2), kNearly);
  EXPECT_NEAR(CVector3(2, 9, 1).GetYAngle().GetValue(), std::atan2(2, 1), kNearly);
  EXPECT_NEAR(CVector3(2, 1, 9).GetZAngle().GetValue(), std::atan2(1, 2), kNearly);
  // Vectors are compared in each of the three.
  const CVector3 low(1, 1, 1);
  for (const CVector3& beside : {CVector3(1, 2, 2), CVector3(2, 1, 2), CVector3(2, 2, 1)})
  {
    EXPECT_TRUE(low <= beside && beside >= low && !(low < beside) && !(beside > low)) << beside;
    EXPECT_FALSE(beside <= low || low >= beside) << beside;
  }
  EXPECT_TRUE(low < CVector3(2, 2, 2) && CVector3(2, 2, 2) > low && !(CVector3(2, 2, 2) < low) && !(low > low));
  for (const CVector3& across : {CVector3(0, 2, 2), CVector3(2, 0, 2), CVector3(2, 2, 0)})
    EXPECT_FALSE(low <= across || low < across || low >= across || low > across) << across;
}

TEST(Argos3Vectors, SphericalCoordinatesAreLengthInclinationAndAzimuth)
{
  const CVector3 vector(2, CRadians(0.7), CRadians(-2));
  EXPECT_LT(
      Distance(vector, CVector3(2 * std::sin(0.7) * std::cos(2), -2 * std::sin(0.7) * std::sin(2), 2 * std::cos(0.7))),
      kNearly);
  Real length = 0;
  CRadians inclination, azimuth;
  vector.ToSphericalCoords(length, inclination, azimuth);
  EXPECT_NEAR(length, 2, kNearly);
  EXPECT_NEAR(inclination.GetValue(), 0.7, kNearly);
  EXPECT_NEAR(azimuth.GetValue(), -2, kNearly);
}

TEST(Argos3Vectors, RotationsAboutAxesAreEigens)
{
  for (double angle = -3; angle <= 3; angle += 0.7)
  {
    const Eigen::Vector3d vector(1, 2, -3);
    const auto expect = [&](const Eigen::Vector3d& axis, const CVector3& turned)
    {
      const Eigen::Vector3d expected = Eigen::AngleAxisd(angle, axis) * vector;
      EXPECT_LT(Distance(turned, CVector3(expected.x(), expected.y(), expected.z())), kNearly) << angle;
    };
    expect(Eigen::Vector3d::UnitX(), CVector3(1, 2, -3).RotateX(CRadians(angle)));
    expect(Eigen::Vector3d::UnitY(), CVector3(1, 2, -3).RotateY(CRadians(angle)));
    expect(Eigen::Vector3d::UnitZ(), CVector3(1, 2, -3).RotateZ(CRadians(angle)));
    expect(Eigen::Vector3d::UnitZ(), CVector3(1, 2, -3).RotateZ(CVector2(1, CRadians(angle))));
  }
}

TEST(Argos3Vectors, QuaternionsAreEigens)
{
  CQuaternion a(1, 2, -3, 4);
  const CQuaternion b(-0.5, 1, 0.25, 2);
  const auto same = [](const CQuaternion& q, const Eigen::Quaterniond& expected)
  {
    EXPECT_NEAR(q.GetW(), expected.w(), kNearly);
    EXPECT_NEAR(q.GetX(), expected.x(), kNearly);
    EXPECT_NEAR(q.GetY(), expected.y(), kNearly);
    EXPECT_NEAR(q.GetZ(), expected.z(), kNearly);
  };
  const Eigen::Quaterniond first(1, 2, -3, 4), second(-0.5, 1, 0.25, 2);
  same(a * b, first * second);
  same(b * a, second * first);
  same(a.Conjugate(), first.conjugate());
  same(a.Inverse(), first.conjugate());
  same(CQuaternion(a).Normalize(), first.normalized());
  EXPECT_EQ(a + b, CQuaternion(0.5, 3, -2.75, 6));
  EXPECT_EQ(a - b, CQuaternion(1.5, 1, -3.25, 2));
  EXPECT_EQ(a.SquareLength(), 30);
  EXPECT_DOUBLE_EQ(a.Length(), std::sqrt(30));
  a += b;
  a -= CQuaternion(0, 1, 1, 1);
  EXPECT_EQ(a, CQuaternion(0.5, 2, -3.75, 5));
  a.SetW(9);
  a.SetX(8);
  a.SetY(7);
  a.SetZ(6);
  EXPECT_EQ(a, CQuaternion(9, 8, 7, 6));
  a.Set(1, 2, 3, 4);
  EXPECT_EQ(a, CQuaternion(1, 2, 3, 4));
  for (const CQuaternion& other :
       {CQuaternion(0, 2, 3, 4), CQuaternion(1, 0, 3, 4), CQuaternion(1, 2, 0, 4), CQuaternion(1, 2, 3, 0)})
    EXPECT_TRUE(a != other && !(a == other));
  EXPECT_EQ(CQuaternion(), CQuaternion(1, 0, 0, 0));
}

TEST(Argos3Vectors, QuaternionsAreAnglesAboutAnAxis)
{
  CRadians angle;
  CVector3 axis;
  CQuaternion(CRadians(0.8), CVector3(0.6, 0, -0.8)).ToAngleAxis(angle, axis);
  EXPECT_NEAR(angle.GetValue(), 0.8, kNearly);
  EXPECT_LT(Distance(axis, CVector3(0.6, 0, -0.8)), kNearly);
  CQuaternion().ToAngleAxis(angle, axis);
  EXPECT_EQ(angle.GetValue(), 0);
  EXPECT_EQ(axis, CVector3::Z) << "the identity turns about z";
}

TEST(Argos3Vectors, EulerAnglesAtAQuarterTurnAboutYAreAllOfZ)
{
  for (const double side : {1.0, -1.0})
    for (const double turn : {-2.0, -0.3, 0.0, 0.9, 2.5})
    {
      CQuaternion rotation;
      rotation.FromEulerAngles(CRadians(turn), side * CRadians::PI_OVER_TWO, CRadians(0));
      CRadians z, y, x;
      rotation.ToEulerAngles(z, y, x);
      EXPECT_NEAR(z.GetValue(), turn, 1e-6) << side;
      EXPECT_NEAR(y.GetValue(), side * kHalfTurn / 2, kNearly) << turn;
      EXPECT_EQ(x.GetValue(), 0);
    }
  // 3.6 degrees before it, all three are told.
  CQuaternion rotation;
  rotation.FromEulerAngles(CRadians(0.4), CRadians(1.5), CRadians(-0.2));
  CRadians z, y, x;
  rotation.ToEulerAngles(z, y, x);
  EXPECT_NEAR(z.GetValue(), 0.4, 1e-9);
  EXPECT_NEAR(y.GetValue(), 1.5, 1e-9);
  EXPECT_NEAR(x.GetValue(), -0.2, 1e-9);
}

TEST(Argos3Vectors, QuaternionsInFilesAreDegreesAboutZThenYThenX)
{
  const auto read = ReadFrom<CQuaternion>("30,20,10");
  CQuaternion expected;
  expected.FromEulerAngles(ToRadians(CDegrees(30)), ToRadians(CDegrees(20)), ToRadians(CDegrees(10)));
  EXPECT_EQ(read, expected);
  std::ostringstream text;
  text << std::setprecision(4) << read;
  EXPECT_EQ(text.str(), "30,20,10");
  EXPECT_THROW(ReadFrom<CQuaternion>("30,20"), CARGoSException);
}

TEST(Argos3Vectors, RotationsBetweenNearlyOppositeVectors)
{
  const CVector3 axes[] = {CVector3(2, 0, 0), CVector3(0, 3, 0), CVector3(0, 0, 0.5)};
  for (int i = 0; i < 3; ++i)
  {
    const CVector3& from = axes[i];
    const CVector3& beside = axes[(i + 1) % 3];
    CVector3 turned = from;
    EXPECT_LT(Distance(turned.Rotate(CQuaternion(from, -from)), -from), 1e-9) << from;
    for (const double away : {1.0, 0.3, 0.01, 0.003})
    {
      const CVector3 to = std::sin(away) * beside / beside.Length() - std::cos(away) * from / from.Length();
      turned = from;
      EXPECT_LT(Distance(turned.Rotate(CQuaternion(from, 4 * to)), from.Length() * to), 1e-9) << from << " " << away;
    }
  }
}

TEST(Argos3Vectors, RaysHaveDirectionAndLength)
{
  CRay3 ray(CVector3(1, 2, 3), CVector3(0, 0.6, 0.8), 5);
  EXPECT_LT(Distance(ray.GetEnd(), CVector3(1, 5, 7)), kNearly);
  CVector3 direction;
  ray.GetDirection(direction);
  EXPECT_LT(Distance(direction, CVector3(0, 0.6, 0.8)), kNearly);
  ray.GetInverseDirection(direction);
  EXPECT_LT(Distance(direction, CVector3(0, -0.6, -0.8)), kNearly);
  EXPECT_LT(Distance(ray.ToVector(direction), CVector3(0, 3, 4)), kNearly);
  CVector3 point;
  ray.GetPoint(point, 0.25);
  EXPECT_LT(Distance(point, CVector3(1, 2.75, 4)), kNearly);
  ray.SetStart(CVector3(0, 0, 0));
  ray.SetEnd(CVector3(2, 0, 0));
  EXPECT_EQ(ToString(ray), "0,0,0 -> 2,0,0");
  ray.Set(CVector3(1, 0, 0), CVector3(0, 1, 0));
  EXPECT_EQ(ToString(ray), "1,0,0 -> 0,1,0");
  EXPECT_EQ(CRay3().GetLength(), 0);
  // Ends on the plane belong to the ray.
  const CPlane wall(CVector3(2, 7, 7), CVector3::X);
  EXPECT_TRUE(CRay3(CVector3(0, 0, 0), CVector3(2, 4, 0)).Intersects(wall, point));
  EXPECT_LT(Distance(point, CVector3(2, 4, 0)), kNearly);
  EXPECT_TRUE(CRay3(CVector3(2, 1, 0), CVector3(5, 4, 0)).Intersects(wall, point));
  EXPECT_LT(Distance(point, CVector3(2, 1, 0)), kNearly);
  EXPECT_FALSE(CRay3(CVector3(3, 1, 0), CVector3(5, 4, 0)).Intersects(wall, point)) << "behind the start";

  CRay2 flat(CVector2(1, 2), CVector2(0.6, -0.8), 5);
  EXPECT_LT(Distance(flat.GetEnd(), CVector2(4, -2)), kNearly);
  EXPECT_DOUBLE_EQ(flat.GetLength(), 5);
  EXPECT_DOUBLE_EQ(flat.GetDistance(-0.4), 2);
  CVector2 way;
  flat.GetDirection(way);
  EXPECT_LT(Distance(way, CVector2(0.6, -0.8)), kNearly);
  flat.GetInverseDirection(way);
  EXPECT_LT(Distance(way, CVector2(-0.6, 0.8)), kNearly);
  flat.ToVector(way);
  EXPECT_LT(Distance(way, CVector2(3, -4)), kNearly);
  flat.GetPoint(way, 0.5);
  EXPECT_LT(Distance(way, CVector2(2.5, 0)), kNearly);
  flat.SetStart(CVector2(0, 1));
  flat.SetEnd(CVector2(2, 1));
  EXPECT_EQ(ToString(flat), "0,1 -> 2,1");
  EXPECT_EQ(flat.GetStart(), CVector2(0, 1));
  flat.Set(CVector2(1, 0), CVector2(0, 1));
  EXPECT_EQ(ToString(flat), "1,0 -> 0,1");
}

TEST(Argos3Vectors, RaysOfThePlaneCrossOrTouch)
{
  const CRay2 ray(CVector2(0, 0), CVector2(4, 0));
  for (const double x : {0.0, 2.0, 4.0})
  {
    EXPECT_TRUE(ray.Intersects(CRay2(CVector2(x, -1), CVector2(x, 1)))) << x;
    EXPECT_TRUE(ray.Intersects(CRay2(CVector2(x, 0), CVector2(x + 1, 2)))) << "starts on it, " << x;
    EXPECT_TRUE(ray.Intersects(CRay2(CVector2(x, 2), CVector2(x, 0)))) << "ends on it, " << x;
  }
  for (const double x : {-0.1, 4.1}) EXPECT_FALSE(ray.Intersects(CRay2(CVector2(x, -1), CVector2(x, 1)))) << x;
  EXPECT_FALSE(ray.Intersects(CRay2(CVector2(2, 0.1), CVector2(2, 1))));
  EXPECT_FALSE(ray.Intersects(CRay2(CVector2(2, -1), CVector2(2, -0.1))));
  EXPECT_FALSE(ray.Intersects(CRay2(CVector2(1, 0), CVector2(5, 0)))) << "parallel ones do not";
  // Long rays that are nearly parallel count as parallel, short ones at a right angle do not.
  EXPECT_FALSE(CRay2(CVector2(0, 0), CVector2(1e4, 0)).Intersects(CRay2(CVector2(0, -1e-9), CVector2(1e4, 1e-9))));
  EXPECT_TRUE(CRay2(CVector2(0, 0), CVector2(1e-3, 0)).Intersects(CRay2(CVector2(5e-4, -1e-4), CVector2(5e-4, 1e-4))));
}

TEST(Argos3Vectors, BodiesAreMetFromTheStartOfARayOn)
{
  CBox box(CVector3(2, 4, 6));
  EXPECT_EQ(box.GetBasePosition(), CVector3());
  EXPECT_EQ(box.GetOrientation(), CQuaternion());
  CCylinder cylinder(1, 6);
  EXPECT_EQ(cylinder.GetBasePosition(), CVector3());
  EXPECT_EQ(cylinder.GetAxis(), CVector3::Z);
  const auto meets_both = [&](const CVector3& from, const CVector3& to, bool meets, double at = 0)
  {
    const CRay3 ray(from, to);
    Real t = -1;
    EXPECT_EQ(box.Intersects(t, ray), meets) << ray;
    EXPECT_NEAR(t, meets ? at : -1, kNearly) << ray;
    t = -1;
    EXPECT_EQ(cylinder.Intersects(t, ray), meets) << ray;
    EXPECT_NEAR(t, meets ? at : -1, kNearly) << ray;
  };
  meets_both(CVector3(-3, 0, 3), CVector3(1, 0, 3), true, 0.5);
  meets_both(CVector3(-3, 0, 3), CVector3(-2, 0, 3), true, 2);     // its line does, beyond the end
  meets_both(CVector3(3, 0, 3), CVector3(4, 0, 3), false);         // behind the start
  meets_both(CVector3(0, 0, 3), CVector3(4, 0, 3), true, 0.25);    // from within: where it leaves
  meets_both(CVector3(0, 0, 8), CVector3(0, 0, 4), true, 0.5);     // from above, along the axis
  meets_both(CVector3(0, 0, -3), CVector3(0, 0, 3), true, 0.5);    // from below
  meets_both(CVector3(0, 0, 3), CVector3(0, 0, 9), true, 0.5);     // from within, upwards
  meets_both(CVector3(1.5, 0, 8), CVector3(1.5, 0, 4), false);     // beside it
  meets_both(CVector3(-3, 0, 6.5), CVector3(1, 0, 6.5), false);    // above it
  meets_both(CVector3(-3, 0, -0.5), CVector3(1, 0, -0.5), false);  // below it
  meets_both(CVector3(-3, 4.5, 3), CVector3(3, 4.5, 3), false);
  meets_both(CVector3(-3, 0, 3), CVector3(3, 60, 3), false);    // to the side
  meets_both(CVector3(-3, 0, 3), CVector3(-1, 0, 6), true, 1);  // over the edge of the top
  meets_both(CVector3(-3, 0, 3), CVector3(-1, 0, 6.1), false);
  box.SetSize(CVector3(2, 2, 1));
  box.SetBasePosition(CVector3(0, 0, 5));
  box.SetOrientation(CQuaternion(CRadians::PI_OVER_TWO, CVector3::X));
  cylinder.SetRadius(0.5);
  cylinder.SetHeight(1);
  cylinder.SetBasePosition(CVector3(0, 0, 5));
  cylinder.SetAxis(-CVector3::Y);
  EXPECT_EQ(box.GetSize(), CVector3(2, 2, 1));
  EXPECT_EQ(cylinder.GetRadius(), 0.5);
  EXPECT_EQ(cylinder.GetHeight(), 1);
  // Both lie on the side now, from y 0 to -1.
  meets_both(CVector3(0, 4, 5), CVector3(0, -4, 5), true, 0.5);
  meets_both(CVector3(0, -4, 5), CVector3(0, 4, 5), true, 0.375);
  meets_both(CVector3(0, 0.5, 5), CVector3(0, 4, 5), false);
}

TEST(Argos3Vectors, PlanesAndPosesHaveTheirParts)
{
  CPlane plane;
  EXPECT_EQ(plane.GetNormal(), CVector3::Z) << "the floor";
  EXPECT_EQ(plane.GetPosition(), CVector3());
  plane.SetPosition(CVector3(1, 2, 3));
  plane.SetNormal(CVector3::X);
  EXPECT_EQ(plane.GetPosition(), CVector3(1, 2, 3));
  EXPECT_EQ(plane.GetNormal(), CVector3::X);

  CPose2 pose(1, 2, 0.5);
  EXPECT_EQ(pose, CPose2(CVector2(1, 2), CRadians(0.5)));
  for (const CPose2& other : {CPose2(0, 2, 0.5), CPose2(1, 0, 0.5), CPose2(1, 2, 0)})
    EXPECT_TRUE(pose != other && !(pose == other)) << other;
  pose.Rotate(CRadians(0.25));
  EXPECT_EQ(pose.GetOrientation().GetValue(), 0.75);
  EXPECT_EQ(CPose2(), CPose2(0, 0, 0));
  EXPECT_EQ(ToString(CPose2(1, 2, 0)), "CPose2(1,2, CRadians(0 -> 0 degrees))");
  // A heading is told with its sign.
  const CPose2 right(CVector3(), CQuaternion(CRadians(-0.4), CVector3::Z));
  EXPECT_NEAR(right.GetOrientation().GetValue(), -0.4, kNearly);
  // The product of poses is in the frame of the first one, and its heading is within half a turn.
  const CPose2 product = CPose2(1, 2, 3) * CPose2(2, 1, 1);
  EXPECT_NEAR(product.GetOrientation().GetValue(), 4 - 2 * kHalfTurn, kNearly);
  EXPECT_LT(
      Distance(product.GetPosition(), CVector2(1 + 2 * std::cos(3) - std::sin(3), 2 + 2 * std::sin(3) + std::cos(3))),
      kNearly);
  const CPose2 inverse = CPose2(1, 2, 0.5).Inverse();
  EXPECT_NEAR(inverse.GetOrientation().GetValue(), -0.5, kNearly);
  EXPECT_LT(Distance(inverse * CVector2(1, 2), CVector2()), kNearly);
}

}  // namespace
