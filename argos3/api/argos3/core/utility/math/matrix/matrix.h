// CMatrix<ROWS, COLS>: numbers in rows, counted from 0. They are zero at first.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>
#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

template <UInt32 ROWS, UInt32 COLS>
class CMatrix
{
public:
  CMatrix() { std::fill_n(m_pfValues, ROWS * COLS, Real(0)); }
  // `values` are row by row.
  CMatrix(const Real* values) { Set(values); }
  void Set(const Real* values) { std::copy_n(values, ROWS * COLS, m_pfValues); }

  // Return an element by row and column, or by its number row by row. Throw CARGoSException for an element that does
  // not exist.
  Real& operator()(UInt32 row, UInt32 column) { return m_pfValues[IndexOf(row, column)]; }
  Real operator()(UInt32 row, UInt32 column) const { return m_pfValues[IndexOf(row, column)]; }
  Real& operator()(UInt32 index) { return m_pfValues[Checked(index)]; }
  Real operator()(UInt32 index) const { return m_pfValues[Checked(index)]; }

  CMatrix<COLS, ROWS> GetTransposed() const
  {
    CMatrix<COLS, ROWS> transposed;
    for (UInt32 row = 0; row < ROWS; ++row)
      for (UInt32 column = 0; column < COLS; ++column) transposed(column, row) = (*this)(row, column);
    return transposed;
  }
  // Returns the part whose first element is at that row and column. Throws CARGoSException if it reaches beyond the
  // matrix.
  template <UInt32 PART_ROWS, UInt32 PART_COLS>
  CMatrix<PART_ROWS, PART_COLS>& GetSubmatrix(CMatrix<PART_ROWS, PART_COLS>& part, UInt32 row, UInt32 column) const
  {
    for (UInt32 i = 0; i < PART_ROWS; ++i)
      for (UInt32 j = 0; j < PART_COLS; ++j) part(i, j) = (*this)(row + i, column + j);
    return part;
  }

  bool operator==(const CMatrix& other) const
  {
    return std::equal(m_pfValues, m_pfValues + ROWS * COLS, other.m_pfValues);
  }
  bool operator!=(const CMatrix& other) const { return !(*this == other); }
  CMatrix& operator+=(const CMatrix& other)
  {
    for (UInt32 i = 0; i < ROWS * COLS; ++i) m_pfValues[i] += other.m_pfValues[i];
    return *this;
  }
  CMatrix& operator-=(const CMatrix& other)
  {
    for (UInt32 i = 0; i < ROWS * COLS; ++i) m_pfValues[i] -= other.m_pfValues[i];
    return *this;
  }
  CMatrix& operator*=(Real factor)
  {
    for (Real& value : m_pfValues) value *= factor;
    return *this;
  }
  CMatrix& operator*=(const CMatrix<COLS, COLS>& other) { return *this = *this * other; }
  CMatrix operator+(const CMatrix& other) const { return CMatrix(*this) += other; }
  CMatrix operator-(const CMatrix& other) const { return CMatrix(*this) -= other; }
  template <UInt32 OTHER_COLS>
  CMatrix<ROWS, OTHER_COLS> operator*(const CMatrix<COLS, OTHER_COLS>& other) const
  {
    CMatrix<ROWS, OTHER_COLS> product;
    for (UInt32 i = 0; i < ROWS; ++i)
      for (UInt32 j = 0; j < OTHER_COLS; ++j)
        for (UInt32 k = 0; k < COLS; ++k) product(i, j) += (*this)(i, k) * other(k, j);
    return product;
  }

  // Writes a line for each row, with one decimal.
  friend std::ostream& operator<<(std::ostream& stream, const CMatrix& matrix)
  {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1);
    for (UInt32 row = 0; row < ROWS; ++row)
    {
      text << "|";
      for (UInt32 column = 0; column < COLS; ++column) text << " " << std::setw(6) << matrix(row, column);
      text << " |\n";
    }
    return stream << text.str();
  }

protected:
  Real m_pfValues[ROWS * COLS];

private:
  static UInt32 IndexOf(UInt32 row, UInt32 column)
  {
    if (row >= ROWS || column >= COLS)
      THROW_ARGOSEXCEPTION("element " << row << ", " << column << " of a matrix of " << ROWS << " by " << COLS
                                      << "; the first one is 0, 0");
    return row * COLS + column;
  }
  static UInt32 Checked(UInt32 index)
  {
    if (index >= ROWS * COLS)
      THROW_ARGOSEXCEPTION("element " << index << " of a matrix of " << ROWS << " by " << COLS
                                      << "; the first one is 0");
    return index;
  }
};

}  // namespace argos
