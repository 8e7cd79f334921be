// Asks CMA-ES or an algorithm of NLopt for the next values that it needs. It has no state to store: each call starts
// the algorithm again and gives it the known values, which leads to the same questions. One thread.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studies/design/study.h"

namespace swarmanoid
{

struct KnownValue
{
  enum class Kind
  {
    kUnknown,
    kValue,
    kRefused  // a place that is not allowed, or has no value
  };
  Kind kind = Kind::kUnknown;
  double value = 0;
};

class Optimiser
{
public:
  // Returns the value at a place in the unit cube. It is called again for earlier places.
  using Known = std::function<KnownValue(std::span<const double> place)>;

  // `most_questions` limits one search, including known values. Throws ConfigurationError if the algorithm does not
  // accept the population.
  Optimiser(const SearchChoice& search, std::vector<double> start, int most_questions);

  // Returns places whose value the algorithm needs and that do not depend on each other; none if it has ended. The
  // first one is the start. Smaller values are better. A refused place counts as worse than all values known before.
  std::vector<std::vector<double>> Next(const Known& known) const;

private:
  // Returns the last question in the generation of this one; questions are counted from 0.
  std::size_t EndOfGeneration(std::size_t question) const;

  const SearchChoice& search_;
  std::vector<double> start_;
  int most_questions_;
  std::size_t population_;  // 0: the algorithm has none
};

}  // namespace swarmanoid
