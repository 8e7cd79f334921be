// CTransformationMatrix3: a rotation in space, followed by a translation.
#pragma once

#include <argos3/core/utility/math/matrix/rotationmatrix3.h>

namespace argos
{

class CTransformationMatrix3 : public CSquareMatrix<4>
{
public:
  CTransformationMatrix3() { SetIdentityMatrix(); }
  CTransformationMatrix3(const CMatrix<4, 4>& matrix) { SetFromMatrix(matrix); }
  CTransformationMatrix3(const CRotationMatrix3& rotation, const CVector3& translation)
  {
    SetFromComponents(rotation, translation);
  }
  CTransformationMatrix3(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real i, Real j, Real k, Real l,
                         Real m, Real n, Real o, Real p)
  {
    SetFromValues(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  }

  void SetFromMatrix(const CMatrix<4, 4>& matrix)
  {
    for (UInt32 i = 0; i < 16; ++i) m_pfValues[i] = matrix(i);
  }
  void SetFromComponents(const CRotationMatrix3& rotation, const CVector3& translation)
  {
    SetIdentityMatrix();
    SetRotationMatrix(rotation);
    SetTranslationVector(translation);
  }
  // The values are row by row.
  void SetFromValues(Real a, Real b, Real c, Real d, Real e, Real f, Real g, Real h, Real i, Real j, Real k, Real l,
                     Real m, Real n, Real o, Real p)
  {
    const Real values[] = {a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p};
    Set(values);
  }
  void SetRotationMatrix(const CRotationMatrix3& rotation)
  {
    for (UInt32 i = 0; i < 3; ++i)
      for (UInt32 j = 0; j < 3; ++j) (*this)(i, j) = rotation(i, j);
  }
  CRotationMatrix3 GetRotationMatrix() const
  {
    CRotationMatrix3 rotation;
    GetSubmatrix(rotation, 0, 0);
    return rotation;
  }
  void SetTranslationVector(const CVector3& translation)
  {
    for (UInt32 i = 0; i < 3; ++i) (*this)(i, 3) = translation[i];
  }
  CVector3 GetTranslationVector() const { return {(*this)(0, 3), (*this)(1, 3), (*this)(2, 3)}; }

  using CMatrix<4, 4>::operator*;
  CTransformationMatrix3 operator*(const CTransformationMatrix3& other) const
  {
    return CMatrix<4, 4>(*this) * CMatrix<4, 4>(other);
  }
  CVector3 operator*(const CVector3& vector) const { return GetRotationMatrix() * vector + GetTranslationVector(); }
};

}  // namespace argos
