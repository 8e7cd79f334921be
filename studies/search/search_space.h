// The values that a search may try: its factors as sides of the unit cube, a range or a list of values each. One
// thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "studies/design/study.h"

namespace swarmanoid
{

class SearchSpace
{
public:
  // `study` has a search and must outlive the object.
  explicit SearchSpace(const Study& study);

  // Returns the place where the search begins: of a list of values the first.
  std::vector<double> Start() const;
  // Returns for each side 0 for a range, or the number of its values.
  std::vector<std::size_t> Levels() const;
  // Returns the values of all factors, including fixed ones, in the order of the study. `place` is in the unit cube.
  // Numbers are rounded to twelve digits, so that their texts are exact.
  std::vector<ExpressionValue> Values(std::span<const double> place) const;
  // Returns whether the conditions of the study allow the values.
  bool Allows(const std::vector<ExpressionValue>& values) const;
  // Returns the experiment file of a run: that of its variant, if it has one.
  const std::string& Experiment(const std::vector<ExpressionValue>& values) const;
  // Returns the values for --set, except the seed.
  StudySettings Settings(const std::vector<ExpressionValue>& values) const;
  // Returns a text such as "speed=0.05 robots=20".
  std::string Text(const std::vector<ExpressionValue>& values) const;

private:
  const Study& study_;
  std::vector<const Factor*> factors_;
  std::vector<std::size_t> searched_;  // indices in factors_
  std::vector<Expression> conditions_;
};

}  // namespace swarmanoid
