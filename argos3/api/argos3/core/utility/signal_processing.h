// CStats and CRCLowPassFilter, for sequences of numbers.
#pragma once

#include <argos3/core/utility/math/general.h>

namespace argos
{

// Computes mean and variance (Welford's sums).
class CStats
{
public:
  void Append(Real value)
  {
    ++count_;
    const Real away = value - mean_;
    mean_ += away / static_cast<Real>(count_);
    squares_ += away * (value - mean_);
  }
  Real GetMean() const { return mean_; }
  // Returns the variance of the population from which the numbers are a sample; 0 for fewer than two.
  Real GetVariance() const { return count_ > 1 ? squares_ / static_cast<Real>(count_ - 1) : 0; }
  Real GetStdDev() const { return Sqrt(GetVariance()); }

private:
  UInt64 count_ = 0;
  Real mean_ = 0;
  Real squares_ = 0;
};

// Each output is between the input and the previous output: with `smoothing` 0 it follows the input, with 1 it never
// changes.
class CRCLowPassFilter
{
public:
  CRCLowPassFilter(Real smoothing) : smoothing_(smoothing) {}
  // The first input is returned unchanged.
  Real Filter(Real input)
  {
    output_ = is_first_ ? input : input + smoothing_ * (output_ - input);
    is_first_ = false;
    return output_;
  }
  void Reset() { is_first_ = true; }

private:
  Real smoothing_;
  Real output_ = 0;
  bool is_first_ = true;
};

}  // namespace argos
