// CSquareMatrix<DIM>: a matrix with determinant and inverse.
#pragma once

#include <argos3/core/utility/math/matrix/matrix.h>

namespace argos
{

template <UInt32 DIM>
class CSquareMatrix : public CMatrix<DIM, DIM>
{
public:
  CSquareMatrix() = default;
  CSquareMatrix(const CMatrix<DIM, DIM>& other) : CMatrix<DIM, DIM>(other) {}

  void SetIdentityMatrix()
  {
    for (UInt32 i = 0; i < DIM; ++i)
      for (UInt32 j = 0; j < DIM; ++j) (*this)(i, j) = i == j ? 1 : 0;
  }
  bool IsIdentityMatrix() const
  {
    CSquareMatrix identity;
    identity.SetIdentityMatrix();
    return *this == identity;
  }

  Real GetDeterminant() const;
  // Returns the cofactors: the determinants of the minors, with alternating signs.
  CSquareMatrix GetCofactorMatrix() const;
  CSquareMatrix GetTransposed() const { return CMatrix<DIM, DIM>::GetTransposed(); }
  // If the determinant is 0, the elements are not finite.
  CSquareMatrix GetInverse() const
  {
    CSquareMatrix inverse = GetCofactorMatrix().GetTransposed();
    inverse *= 1 / GetDeterminant();
    return inverse;
  }
};

// Returns the matrix without one row and one column.
template <UInt32 DIM>
CSquareMatrix<DIM - 1> MinorOf(const CSquareMatrix<DIM>& matrix, UInt32 row, UInt32 column)
{
  CSquareMatrix<DIM - 1> rest;
  for (UInt32 i = 0; i < DIM - 1; ++i)
    for (UInt32 j = 0; j < DIM - 1; ++j) rest(i, j) = matrix(i < row ? i : i + 1, j < column ? j : j + 1);
  return rest;
}

template <>
inline Real CSquareMatrix<1>::GetDeterminant() const
{
  return m_pfValues[0];
}

// Expands the determinant along the first row.
template <UInt32 DIM>
Real CSquareMatrix<DIM>::GetDeterminant() const
{
  Real sum = 0;
  for (UInt32 j = 0; j < DIM; ++j) sum += (j % 2 == 0 ? 1 : -1) * (*this)(0, j) * MinorOf(*this, 0, j).GetDeterminant();
  return sum;
}

template <>
inline CSquareMatrix<1> CSquareMatrix<1>::GetCofactorMatrix() const
{
  CSquareMatrix<1> one;
  one.SetIdentityMatrix();
  return one;
}

template <UInt32 DIM>
CSquareMatrix<DIM> CSquareMatrix<DIM>::GetCofactorMatrix() const
{
  CSquareMatrix cofactors;
  for (UInt32 i = 0; i < DIM; ++i)
    for (UInt32 j = 0; j < DIM; ++j)
      cofactors(i, j) = ((i + j) % 2 == 0 ? 1 : -1) * MinorOf(*this, i, j).GetDeterminant();
  return cofactors;
}

}  // namespace argos
