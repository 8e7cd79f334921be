// CRotationMatrix3: a rotation in space.
#pragma once

#include <argos3/core/utility/math/matrix/squarematrix.h>
#include <argos3/core/utility/math/quaternion.h>

namespace argos
{

class CRotationMatrix3 : public CSquareMatrix<3>
{
public:
  CRotationMatrix3() { SetIdentityMatrix(); }
  // Copies the matrix without a check that it is a rotation.
  CRotationMatrix3(const CMatrix<3, 3>& matrix) { SetFromMatrix(matrix); }
  CRotationMatrix3(const CQuaternion& rotation) { SetFromQuaternion(rotation); }
  CRotationMatrix3(const CRadians& z, const CRadians& y, const CRadians& x) { SetFromAngles(z, y, x); }
  CRotationMatrix3(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real i)
  {
    SetFromValues(a, b, c, d, e, f, g, h, i);
  }

  void SetFromMatrix(const CMatrix<3, 3>& matrix)
  {
    for (UInt32 i = 0; i < 9; ++i) m_pfValues[i] = matrix(i);
  }
  // Rotates about the axes x, then y, then z of a fixed frame. The angles of CQuaternion differ, since its frame
  // rotates.
  void SetFromAngles(const CRadians& z, const CRadians& y, const CRadians& x)
  {
    SetFromAxes(CVector3(CVector3::X).RotateX(x).RotateY(y).RotateZ(z),
                CVector3(CVector3::Y).RotateX(x).RotateY(y).RotateZ(z),
                CVector3(CVector3::Z).RotateX(x).RotateY(y).RotateZ(z));
  }
  void SetFromQuaternion(const CQuaternion& rotation)
  {
    SetFromAxes(CVector3(CVector3::X).Rotate(rotation), CVector3(CVector3::Y).Rotate(rotation),
                CVector3(CVector3::Z).Rotate(rotation));
  }
  // The values are row by row.
  void SetFromValues(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real i)
  {
    const Real values[] = {a, b, c, d, e, f, g, h, i};
    Set(values);
  }

  operator CQuaternion() const;

  using CMatrix<3, 3>::operator*;
  CVector3 operator*(const CVector3& vector) const
  {
    CVector3 product;
    for (UInt32 i = 0; i < 3; ++i)
      product[i] = CVector3((*this)(i, 0), (*this)(i, 1), (*this)(i, 2)).DotProduct(vector);
    return product;
  }

private:
  // `x`, `y` and `z` are the images of the axes.
  void SetFromAxes(const CVector3& x, const CVector3& y, const CVector3& z)
  {
    SetFromValues(x.GetX(), y.GetX(), z.GetX(), x.GetY(), y.GetY(), z.GetY(), x.GetZ(), y.GetZ(), z.GetZ());
  }
};

// The largest of the four elements is computed first. Four times its product with each element is a sum of matrix
// elements.
inline CRotationMatrix3::operator CQuaternion() const
{
  const CRotationMatrix3& m = *this;
  const Real squares[4] = {1 + m(0, 0) + m(1, 1) + m(2, 2), 1 + m(0, 0) - m(1, 1) - m(2, 2),
                           1 - m(0, 0) + m(1, 1) - m(2, 2), 1 - m(0, 0) - m(1, 1) + m(2, 2)};
  const Real wx = m(2, 1) - m(1, 2);
  const Real wy = m(0, 2) - m(2, 0);
  const Real wz = m(1, 0) - m(0, 1);
  const Real xy = m(1, 0) + m(0, 1);
  const Real xz = m(2, 0) + m(0, 2);
  const Real yz = m(2, 1) + m(1, 2);
  const Real products[4][4] = {
      {squares[0], wx, wy, wz}, {wx, squares[1], xy, xz}, {wy, xy, squares[2], yz}, {wz, xz, yz, squares[3]}};
  const auto largest = std::max_element(squares, squares + 4) - squares;
  const Real divisor = 2 * Sqrt(squares[largest]);
  const Real* row = products[largest];
  return {row[0] / divisor, row[1] / divisor, row[2] / divisor, row[3] / divisor};
}

}  // namespace argos
