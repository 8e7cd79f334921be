// Matrices and bodies of ARGoS3's mathematics, beside Eigen's and beside points.
#include <argos3/core/utility/math/box.h>
#include <argos3/core/utility/math/convex_hull.h>
#include <argos3/core/utility/math/cylinder.h>
#include <argos3/core/utility/math/matrix/transformationmatrix2.h>
#include <argos3/core/utility/math/matrix/transformationmatrix3.h>
#include <argos3/core/utility/math/pose2.h>
#include <argos3/core/utility/math/ray2.h>
#include <argos3/core/utility/math/rng.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace
{

using namespace argos;

constexpr double kMatrixTolerance = 1e-12;

CRandom::CRNG& Random()
{
  static CRandom::CRNG random(7);
  return random;
}
Real Drawn() { return Random().Uniform(CRange<Real>(-2, 2)); }
CVector3 DrawnVector() { return {Drawn(), Drawn(), Drawn()}; }

template <UInt32 ROWS, UInt32 COLS>
CMatrix<ROWS, COLS> DrawnMatrix()
{
  CMatrix<ROWS, COLS> matrix;
  for (UInt32 i = 0; i < ROWS * COLS; ++i) matrix(i) = Drawn();
  return matrix;
}

template <UInt32 ROWS, UInt32 COLS>
Eigen::MatrixXd EigenOf(const CMatrix<ROWS, COLS>& matrix)
{
  Eigen::MatrixXd same(ROWS, COLS);
  for (UInt32 row = 0; row < ROWS; ++row)
    for (UInt32 column = 0; column < COLS; ++column) same(row, column) = matrix(row, column);
  return same;
}

TEST(Argos3Matrices, SumsProductsAndPartsAreEigens)
{
  for (int i = 0; i < 50; ++i)
  {
    const CMatrix<2, 3> a = DrawnMatrix<2, 3>(), b = DrawnMatrix<2, 3>();
    const CMatrix<3, 4> c = DrawnMatrix<3, 4>();
    EXPECT_TRUE(EigenOf(a + b).isApprox(EigenOf(a) + EigenOf(b)));
    EXPECT_TRUE(EigenOf(a - b).isApprox(EigenOf(a) - EigenOf(b)));
    EXPECT_TRUE(EigenOf(a * c).isApprox(EigenOf(a) * EigenOf(c)));
    EXPECT_TRUE(EigenOf(a.GetTransposed()).isApprox(EigenOf(a).transpose()));
    CMatrix<3, 3> square = DrawnMatrix<3, 3>();
    EXPECT_TRUE(EigenOf(CMatrix<2, 3>(a) *= square).isApprox(EigenOf(a) * EigenOf(square)));
    CMatrix<2, 2> part;
    EXPECT_TRUE(EigenOf(c.GetSubmatrix(part, 1, 2)).isApprox(EigenOf(c).block(1, 2, 2, 2)));
    EXPECT_THROW(c.GetSubmatrix(part, 2, 2), CARGoSException);
    EXPECT_TRUE(a == a && a != b);
    EXPECT_THROW(static_cast<void>(a(2, 0)), CARGoSException);
    EXPECT_THROW(static_cast<void>(a(6)), CARGoSException);
  }
  const Real values[] = {1, 2.25, -3, 4};
  EXPECT_EQ(ToString(CMatrix<2, 2>(values)), "|    1.0    2.2 |\n|   -3.0    4.0 |\n");
}

TEST(Argos3Matrices, DeterminantsAndInversesAreEigens)
{
  for (int i = 0; i < 50; ++i)
  {
    const CSquareMatrix<4> a = DrawnMatrix<4, 4>();
    EXPECT_NEAR(a.GetDeterminant(), EigenOf(a).determinant(), 1e-9);
    EXPECT_TRUE(EigenOf(a.GetInverse()).isApprox(EigenOf(a).inverse(), 1e-6));
    const CSquareMatrix<2> b = DrawnMatrix<2, 2>();
    EXPECT_TRUE(EigenOf(b.GetInverse()).isApprox(EigenOf(b).inverse(), 1e-6));
  }
  CSquareMatrix<3> identity;
  EXPECT_FALSE(identity.IsIdentityMatrix());
  identity.SetIdentityMatrix();
  EXPECT_TRUE(identity.IsIdentityMatrix());
  EXPECT_EQ(CSquareMatrix<1>(DrawnMatrix<1, 1>()).GetCofactorMatrix()(0), 1);
}

TEST(Argos3Matrices, RotationsTurnVectorsAsQuaternions)
{
  for (int i = 0; i < 200; ++i)
  {
    const CRadians angle(2 * Drawn());
    CVector3 axis = DrawnVector();
    const CQuaternion rotation(i % 4 == 0 ? CRadians::PI : angle, axis.Normalize());
    const CVector3 vector = DrawnVector();
    const CRotationMatrix3 matrix(rotation);
    EXPECT_LT(Distance(matrix * vector, CVector3(vector).Rotate(rotation)), kMatrixTolerance);
    const CQuaternion again = matrix;
    EXPECT_LT(Distance(CVector3(vector).Rotate(again), CVector3(vector).Rotate(rotation)), 1e-9);
    EXPECT_LT(Distance(CRotationMatrix3(matrix * matrix) * vector, matrix * (matrix * vector)), kMatrixTolerance);

    const CVector2 flat(Drawn(), Drawn());
    EXPECT_LT(Distance(CRotationMatrix2(angle) * flat, CVector2(flat).Rotate(angle)), kMatrixTolerance);
  }
  // Fixed axes: x first. The row of z is -sin y, cos y sin x, cos y cos x.
  const CRotationMatrix3 angles(CRadians(0.3), CRadians(0.2), CRadians(0.1));
  EXPECT_NEAR(angles(2, 0), -std::sin(0.2), kMatrixTolerance);
  EXPECT_NEAR(angles(2, 1), std::cos(0.2) * std::sin(0.1), kMatrixTolerance);
  EXPECT_NEAR(angles(1, 0), std::cos(0.2) * std::sin(0.3), kMatrixTolerance);
}

TEST(Argos3Matrices, TransformationsTurnAndThenMove)
{
  const CRotationMatrix3 turn(CRadians(0.3), CRadians(-0.2), CRadians(0.1));
  const CTransformationMatrix3 one(turn, CVector3(1, 2, 3));
  const CTransformationMatrix3 other(CRotationMatrix3(), CVector3(-1, 0, 5));
  const CVector3 vector(0.5, -1, 2);
  EXPECT_LT(Distance(one * vector, turn * vector + CVector3(1, 2, 3)), kMatrixTolerance);
  EXPECT_LT(Distance((one * other) * vector, one * (other * vector)), kMatrixTolerance);
  EXPECT_EQ(one.GetTranslationVector(), CVector3(1, 2, 3));
  EXPECT_EQ(one.GetRotationMatrix(), turn);
  const CTransformationMatrix3 back = one.GetInverse();
  EXPECT_LT(Distance(back * (one * vector), vector), kMatrixTolerance);

  const CTransformationMatrix2 flat(CRotationMatrix2(CRadians::PI_OVER_TWO), CVector2(1, 1));
  EXPECT_LT(Distance(flat * CVector2(2, 0), CVector2(1, 3)), kMatrixTolerance);
  EXPECT_EQ(flat(2, 2), 1);
}

TEST(Argos3Matrices, VectorsAreRowsAndColumns)
{
  const CMatrix<1, 2> row = CVector2(1, 2);
  const CMatrix<2, 1> column = CVector2(3, 4);
  EXPECT_EQ((row * column)(0), 11);
  const CMatrix<3, 1> upright = CVector3(1, 2, 3);
  EXPECT_EQ(upright(2, 0), 3);
  EXPECT_EQ(CVector3(std::array<Real, 3>{1, 2, 3}), CVector3(1, 2, 3));
  CVector2 shadow;
  EXPECT_EQ(CVector3(1, 2, 3).ProjectOntoYZ(shadow), CVector2(2, 3));
  EXPECT_LT(Distance(CVector3(1, 0, 1).RotateZ(CVector2(0, 1)), CVector3(0, 1, 1)), kMatrixTolerance);
}

TEST(Argos3Matrices, PosesOfThePlaneCompose)
{
  const CPose2 pose(CVector2(1, 2), CRadians::PI_OVER_TWO);
  EXPECT_LT(Distance(pose * CVector2(1, 0), CVector2(1, 3)), kMatrixTolerance);
  EXPECT_LT(Distance((pose * pose.Inverse()).GetPosition(), CVector2()), kMatrixTolerance);
  const CPose2 upright(CVector3(1, 2, 5), CQuaternion(CRadians(0.4), CVector3::Z));
  EXPECT_EQ(upright.GetPosition(), CVector2(1, 2));
  EXPECT_NEAR(upright.GetOrientation().GetValue(), 0.4, kMatrixTolerance);
  CPose2 moved = pose;
  moved.Translate(CVector2(0, 1));
  EXPECT_LT(Distance(moved.GetPosition(), CVector2(0, 2)), kMatrixTolerance);
}

TEST(Argos3Matrices, RaysMeetPlanesAndEachOther)
{
  CVector3 point;
  EXPECT_TRUE(CRay3(CVector3(1, 1, 2), CVector3(3, 1, -2)).Intersects(CPlane(), point));
  EXPECT_LT(Distance(point, CVector3(2, 1, 0)), kMatrixTolerance);
  EXPECT_FALSE(CRay3(CVector3(0, 0, 2), CVector3(0, 0, 1)).Intersects(CPlane(), point));
  EXPECT_FALSE(CRay3(CVector3(0, 0, 2), CVector3(1, 0, 2)).Intersects(CPlane(), point));

  const CRay2 ray(CVector2(0, 0), CVector2(4, 4));
  EXPECT_TRUE(ray.Intersects(CRay2(CVector2(0, 4), CVector2(4, 0))));
  EXPECT_FALSE(ray.Intersects(CRay2(CVector2(0, 4), CVector2(1, 3))));
  EXPECT_FALSE(ray.Intersects(CRay2(CVector2(1, 0), CVector2(5, 4))));
}

// The point at which a ray comes to a body is on its surface, and none before it is within.
template <class Body, class IsWithin>
void ExpectFirstHits(const Body& body, IsWithin is_within)
{
  int hits = 0;
  for (int i = 0; i < 400; ++i)
  {
    const CRay3 ray(2 * DrawnVector(), 2 * DrawnVector());
    CVector3 point;
    ray.GetPoint(point, 0);
    if (is_within(point)) continue;
    Real t = -1;
    const bool meets = body.Intersects(t, ray);
    if (meets && t <= 1) ++hits;
    for (Real before = 0; before <= 1; before += 0.01)
    {
      ray.GetPoint(point, before);
      EXPECT_FALSE(is_within(point) && (!meets || before < t - 1e-9));
    }
    if (!meets) continue;
    ray.GetPoint(point, t + 1e-7 / ray.GetLength());
    CVector3 outside;
    ray.GetPoint(outside, t - 1e-7 / ray.GetLength());
    EXPECT_TRUE(is_within(point) || Distance(point, outside) < 1e-6);
    EXPECT_FALSE(is_within(outside));
  }
  EXPECT_GT(hits, 20);
}

TEST(Argos3Matrices, RaysMeetBoxesAndCylindersWhereTheyComeFirst)
{
  const CQuaternion lean(CRadians(0.7), CVector3::X);
  const CVector3 base(0.3, -0.2, -1);
  const auto own_frame = [&](const CVector3& point) { return (point - base).Rotate(lean.Inverse()); };
  ExpectFirstHits(CBox(CVector3(1, 2, 1.5), base, lean),
                  [&](const CVector3& point)
                  {
                    const CVector3 own = own_frame(point);
                    return Abs(own.GetX()) < 0.5 && Abs(own.GetY()) < 1 && own.GetZ() > 0 && own.GetZ() < 1.5;
                  });
  ExpectFirstHits(CCylinder(1, 1.5, base, CVector3(CVector3::Z).Rotate(lean)),
                  [&](const CVector3& point)
                  {
                    const CVector3 own = own_frame(point);
                    return Square(own.GetX()) + Square(own.GetY()) < 1 && own.GetZ() > 0 && own.GetZ() < 1.5;
                  });
}

TEST(Argos3Matrices, ConvexHullsAreClosedAndHaveAllPointsWithin)
{
  for (int i = 0; i < 20; ++i)
  {
    std::vector<CVector3> points;
    for (int k = 0; k < 30; ++k) points.push_back(DrawnVector());
    // A cube has four points in each of its planes.
    if (i == 0)
    {
      points.clear();
      for (int k = 0; k < 8; ++k) points.emplace_back(k & 1, k >> 1 & 1, k >> 2);
    }
    const CConvexHull hull(points);
    ASSERT_GE(hull.GetFaces().size(), 4U);
    std::multiset<std::pair<UInt32, UInt32>> edges;
    for (const CConvexHull::SFace& face : hull.GetFaces())
    {
      for (const CVector3& point : points) EXPECT_LT(face.Normal.DotProduct(point), face.Direction + 1e-5);
      for (std::size_t k = 0; k < 3; ++k) edges.insert({face.VertexIndices[k], face.VertexIndices[(k + 1) % 3]});
    }
    for (const auto& edge : edges) EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    // Euler: as many faces as two for each corner but two.
    std::set<UInt32> corners;
    for (const auto& edge : edges) corners.insert(edge.first);
    EXPECT_EQ(hull.GetFaces().size(), 2 * corners.size() - 4);
  }
  EXPECT_TRUE(CConvexHull({CVector3(), CVector3::X, CVector3::Y, CVector3(1, 1, 0)}).GetFaces().empty());
}

}  // namespace
