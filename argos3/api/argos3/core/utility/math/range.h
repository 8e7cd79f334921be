// CRange: an interval of numbers or angles. In files: "min:max".
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>
#include <argos3/core/utility/string_utilities.h>

namespace argos
{

template <class T>
class CRange
{
public:
  constexpr CRange() : CRange(T(), T()) {}
  constexpr CRange(const T& minimum, const T& maximum) : min_(minimum), max_(maximum) {}

  constexpr T GetMin() const { return min_; }
  constexpr T GetMax() const { return max_; }
  constexpr T GetSpan() const { return max_ - min_; }
  // Throw CARGoSException for a minimum above the maximum.
  void SetMin(const T& minimum) { Set(minimum, max_); }
  void SetMax(const T& maximum) { Set(min_, maximum); }
  void Set(const T& minimum, const T& maximum)
  {
    if (minimum > maximum) THROW_ARGOSEXCEPTION("the range " << minimum << ":" << maximum << " ends before it starts");
    min_ = minimum;
    max_ = maximum;
  }

  bool WithinMinBoundIncludedMaxBoundIncluded(const T& value) const { return value >= min_ && value <= max_; }
  bool WithinMinBoundIncludedMaxBoundExcluded(const T& value) const { return value >= min_ && value < max_; }
  bool WithinMinBoundExcludedMaxBoundIncluded(const T& value) const { return value > min_ && value <= max_; }
  bool WithinMinBoundExcludedMaxBoundExcluded(const T& value) const { return value > min_ && value < max_; }

  // Limits the value to the range.
  void TruncValue(T& value) const
  {
    if (value > max_) value = max_;
    if (value < min_) value = min_;
  }
  // Returns 0 at the minimum to 1 at the maximum, limited to these.
  Real NormalizeValue(const T& value) const
  {
    T cut = value;
    TruncValue(cut);
    return static_cast<Real>(cut - min_) / static_cast<Real>(max_ - min_);
  }
  template <class U>
  void MapValueIntoRange(U& mapped, const T& value, const CRange<U>& range) const
  {
    mapped = static_cast<U>(NormalizeValue(value) * static_cast<Real>(range.GetSpan())) + range.GetMin();
  }
  // Adds or subtracts the span until the value is inside.
  void WrapValue(T& value) const
  {
    for (T before = value; value > max_; before = value)
      if (value -= GetSpan(); !(value < before)) return;
    for (T before = value; value < min_; before = value)
      if (value += GetSpan(); !(value > before)) return;
  }

  friend std::ostream& operator<<(std::ostream& stream, const CRange& range)
  {
    return stream << range.min_ << ":" << range.max_;
  }
  friend std::istream& operator>>(std::istream& stream, CRange& range)
  {
    T ends[2]{};
    ParseValues<T>(stream, 2, ends, ':');
    range.Set(ends[0], ends[1]);
    return stream;
  }

private:
  T min_;
  T max_;
};

}  // namespace argos
