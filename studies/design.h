// All runs of a study: its points, which are the combinations of its factors' values that fulfil the conditions, each
// with every seed. Points are numbered from 0 in the order of the file, the last dimension fastest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/study.h"

namespace swarmanoid
{

// Of one run. Names its folder, and its row of the table.
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
  // `study` outlives it. Throws ConfigurationError if no point fulfils the conditions, or there are too many runs.
  explicit Design(const Study& study);

  std::size_t Points() const { return points_.size(); }
  // One for each factor.
  std::vector<const FactorLevel*> Levels(std::size_t point) const;
  // What --set gets, besides the seed: the study's settings, then those of the factors.
  StudySettings SettingsOf(std::size_t point) const;
  const std::string& ExperimentOf(std::size_t point) const;
  // "robots=10 speed=0.05"
  std::string Text(std::size_t point) const;
  // As conditions see it: numbers and texts, one for each factor.
  ExpressionValue Value(std::size_t point, std::size_t factor) const;
  // For each level of each factor the first point that has it; at most so many, spread evenly.
  std::vector<std::size_t> PointsOfAllLevels(std::size_t most) const;
  // Each once, in alphabetical order.
  std::vector<std::string> ExperimentFiles() const;
  // Of the texts of all experiment files, as 16 hexadecimal digits. Throws ConfigurationError if one cannot be read.
  std::string ExperimentsHash() const;

private:
  std::vector<std::size_t> LevelNumbers(std::uint64_t combination) const;
  ExpressionValue ValueIn(std::uint64_t combination, std::size_t factor) const;

  const Study& study_;
  std::vector<const Factor*> factors_;
  std::vector<std::size_t> dimension_of_;  // of each factor
  std::vector<std::uint32_t> points_;      // numbers of combinations
};

}  // namespace swarmanoid
