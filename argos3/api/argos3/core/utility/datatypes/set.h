// CSet: a set, with the names of ARGoS3.
#pragma once

#include <set>

namespace argos
{

template <class T, class Comparator = std::less<T>>
class CSet : public std::set<T, Comparator>
{
public:
  using std::set<T, Comparator>::set;
  bool exists(const T& element) const { return this->count(element) != 0; }
};

}  // namespace argos
