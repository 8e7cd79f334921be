// All runs of a study. Its points are the combinations of its factors' values that fulfil the conditions, each with
// every seed. Points are numbered from 0 in the order of the file, with the last dimension fastest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/design/study.h"

namespace swarmanoid
{

// The name of a run, for its folder and its row of the table.
struct RunName
{
  std::uint32_t point = 0;
  std::uint64_t seed = 0;

  std::string Text() const;  // "12-7"
  friend auto operator<=>(const RunName&, const RunName&) = default;
};

class Design
{
public:
  // `study` must outlive the object. Throws ConfigurationError if no point fulfils the conditions, or if there are too
  // many runs.
  explicit Design(const Study& study);

  std::size_t Points() const { return points_.size(); }
  // Returns one level for each factor.
  std::vector<const FactorLevel*> Levels(std::size_t point) const;
  // Returns the values for --set, except the seed: the study's settings, then those of the factors.
  StudySettings SettingsOf(std::size_t point) const;
  const std::string& ExperimentOf(std::size_t point) const;
  // Returns a text such as "robots=10 speed=0.05".
  std::string Text(std::size_t point) const;
  // Returns the value of a factor as conditions see it: a number or a text.
  ExpressionValue Value(std::size_t point, std::size_t factor) const;
  // Returns, for each level of each factor, the first point that has it. At most `most` points are returned, spread
  // evenly.
  std::vector<std::size_t> PointsOfAllLevels(std::size_t most) const;
  // Returns each file once, in alphabetical order.
  std::vector<std::string> ExperimentFiles() const;
  // Returns the hash of the texts of all experiment files, as 16 hexadecimal digits. Throws ConfigurationError if one
  // cannot be read.
  std::string ExperimentsHash() const;

private:
  std::vector<std::size_t> LevelNumbers(std::uint64_t combination) const;
  ExpressionValue ValueIn(std::uint64_t combination, std::size_t factor) const;

  const Study& study_;
  std::vector<const Factor*> factors_;
  std::vector<std::size_t> dimension_of_;  // by factor
  std::vector<std::uint32_t> points_;      // the numbers of the combinations
};

}  // namespace swarmanoid
