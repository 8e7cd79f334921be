// What a search may try: the ranges of its factors as the unit cube, with one side for each. One thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "studies/study.h"

namespace swarmanoid
{

class SearchSpace
{
public:
  // `study` has a search, and outlives it.
  explicit SearchSpace(const Study& study);

  // Where the search begins.
  std::vector<double> Start() const;
  // Of all factors, fixed ones too, in the order of the study. `place` is in the unit cube. Numbers have twelve digits,
  // so that their texts are them.
  std::vector<ExpressionValue> Values(std::span<const double> place) const;
  // Whether the conditions of the study allow it.
  bool Allows(const std::vector<ExpressionValue>& values) const;
  // What --set gets, besides the seed.
  StudySettings Settings(const std::vector<ExpressionValue>& values) const;
  // "speed=0.05 robots=20"
  std::string Text(const std::vector<ExpressionValue>& values) const;

private:
  const Study& study_;
  std::vector<const Factor*> factors_;
  std::vector<std::size_t> searched_;  // places in factors_
  std::vector<Expression> conditions_;
};

}  // namespace swarmanoid
