// An algorithm of NLopt that can be asked what it wants to know next. It has no state that would have to be kept: each
// time it starts from its beginning and gets the values that are known again, which gives the same questions again. One
// thread.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studies/study.h"

namespace swarmanoid
{

struct KnownValue
{
  enum class Kind
  {
    kUnknown,
    kValue,
    kRefused  // a place that may not be tried, or has no value
  };
  Kind kind = Kind::kUnknown;
  double value = 0;
};

class Optimiser
{
public:
  // A place in the unit cube. Called again for places that were asked for before.
  using Known = std::function<KnownValue(std::span<const double> place)>;

  // `most_questions`: of one search, known ones too. Throws ConfigurationError if the algorithm takes no such
  // population.
  Optimiser(const SearchChoice& search, std::vector<double> start, int most_questions);

  // Places whose value it needs, which do not depend on one another; none if it has ended. The first one is the start.
  // Smaller values are better. What is refused counts as worse than all that was known before.
  std::vector<std::vector<double>> Next(const Known& known) const;

private:
  // The last of the questions that go together with this one: they are counted from 0.
  std::size_t EndOfGeneration(std::size_t question) const;

  const SearchChoice& search_;
  std::vector<double> start_;
  int most_questions_;
  std::size_t population_;  // 0: the algorithm has none
};

// Those that <search> may name.
const std::vector<std::string>& SearchAlgorithms();

}  // namespace swarmanoid
