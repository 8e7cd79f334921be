// CTransformationMatrix2: a rotation in the plane, followed by a translation.
#pragma once

#include <argos3/core/utility/math/matrix/rotationmatrix2.h>

namespace argos
{

class CTransformationMatrix2 : public CSquareMatrix<3>
{
public:
  CTransformationMatrix2() { SetIdentityMatrix(); }
  CTransformationMatrix2(const CMatrix<3, 3>& matrix) { SetFromMatrix(matrix); }
  CTransformationMatrix2(const CRotationMatrix2& rotation, const CVector2& translation)
  {
    SetFromComponents(rotation, translation);
  }
  CTransformationMatrix2(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real i)
  {
    SetFromValues(a, b, c, d, e, f, g, h, i);
  }

  void SetFromMatrix(const CMatrix<3, 3>& matrix)
  {
    for (UInt32 i = 0; i < 9; ++i) m_pfValues[i] = matrix(i);
  }
  void SetFromComponents(const CRotationMatrix2& rotation, const CVector2& translation)
  {
    SetIdentityMatrix();
    SetRotationMatrix(rotation);
    SetTranslationVector(translation);
  }
  // The values are row by row.
  void SetFromValues(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real i)
  {
    const Real values[] = {a, b, c, d, e, f, g, h, i};
    Set(values);
  }
  void SetRotationMatrix(const CRotationMatrix2& rotation)
  {
    for (UInt32 i = 0; i < 2; ++i)
      for (UInt32 j = 0; j < 2; ++j) (*this)(i, j) = rotation(i, j);
  }
  CRotationMatrix2 GetRotationMatrix() const
  {
    CRotationMatrix2 rotation;
    GetSubmatrix(rotation, 0, 0);
    return rotation;
  }
  void SetTranslationVector(const CVector2& translation)
  {
    (*this)(0, 2) = translation.GetX();
    (*this)(1, 2) = translation.GetY();
  }
  CVector2 GetTranslationVector() const { return {(*this)(0, 2), (*this)(1, 2)}; }

  using CMatrix<3, 3>::operator*;
  CTransformationMatrix2 operator*(const CTransformationMatrix2& other) const
  {
    return CMatrix<3, 3>(*this) * CMatrix<3, 3>(other);
  }
  CVector2 operator*(const CVector2& vector) const { return GetRotationMatrix() * vector + GetTranslationVector(); }
};

}  // namespace argos
