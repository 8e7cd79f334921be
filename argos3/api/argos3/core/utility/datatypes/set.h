// CSet: a set with the interface of ARGoS3.
#pragma once

#include <functional>
#include <set>

namespace argos
{

template <class T, class Comparator = std::less<T>>
class CSet : public std::set<T, Comparator>
{
public:
  using std::set<T, Comparator>::set;
  CSet() = default;
  // Makes a set of the same elements in another order.
  template <class Other>
  CSet(const CSet<T, Other>& other) : std::set<T, Comparator>(other.begin(), other.end())
  {
  }
  bool exists(const T& element) const { return this->count(element) != 0; }
  // Requires a set that is not empty.
  const T& first() const { return *this->begin(); }
  const T& last() const { return *this->rbegin(); }
};

}  // namespace argos
