// CRotationMatrix2: a rotation in the plane.
#pragma once

#include <argos3/core/utility/math/matrix/squarematrix.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CRotationMatrix2 : public CSquareMatrix<2>
{
public:
  CRotationMatrix2() { SetIdentityMatrix(); }
  // Copies the matrix without a check that it is a rotation.
  CRotationMatrix2(const CMatrix<2, 2>& matrix) { SetFromMatrix(matrix); }
  CRotationMatrix2(const CRadians& angle) { SetFromAngle(angle); }
  CRotationMatrix2(Real a, Real b, Real c, Real d) { SetFromValues(a, b, c, d); }

  void SetFromMatrix(const CMatrix<2, 2>& matrix)
  {
    for (UInt32 i = 0; i < 4; ++i) m_pfValues[i] = matrix(i);
  }
  // The angle is counter-clockwise.
  void SetFromAngle(const CRadians& angle) { SetFromValues(Cos(angle), -Sin(angle), Sin(angle), Cos(angle)); }
  // The values are row by row.
  void SetFromValues(Real a, Real b, Real c, Real d)
  {
    const Real values[] = {a, b, c, d};
    Set(values);
  }

  using CMatrix<2, 2>::operator*;
  CVector2 operator*(const CVector2& vector) const
  {
    return {m_pfValues[0] * vector.GetX() + m_pfValues[1] * vector.GetY(),
            m_pfValues[2] * vector.GetX() + m_pfValues[3] * vector.GetY()};
  }
};

}  // namespace argos
