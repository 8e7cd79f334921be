// A point is one combination of the levels of all dimensions; factors of a <zip> share a dimension and move together.
// Combinations are numbered in mixed radix, with the last dimension fastest, so a point needs only its number, and the
// levels follow from it by division. Points whose combination breaks a condition are left out; points that remain keep
// their order, and the design is the same in every process that reads the same file.
#include "studies/design/design.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <set>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/xml_reader.h"

namespace swarmanoid
{

std::string RunName::Text() const { return fmt::format("{}-{}", point, seed); }

Design::Design(const Study& study) : study_(study), factors_(study.Factors())
{
  for (std::size_t d = 0; d < study.dimensions.size(); ++d)
    for (std::size_t f = 0; f < study.dimensions[d].factors.size(); ++f) dimension_of_.push_back(d);
  std::uint64_t combinations = 1;
  for (const Dimension& dimension : study.dimensions) combinations *= dimension.Size();

  const std::vector<std::string> ids = study.FactorIds();
  std::vector<Expression> conditions;
  // A search chooses its own points and tests the conditions itself.
  if (!study.search)
    for (const StudyCondition& condition : study.conditions) conditions.emplace_back(condition.text, ids);
  for (std::uint64_t k = 0; k < combinations; ++k)
  {
    bool fits = true;
    for (std::size_t c = 0; c < conditions.size() && fits; ++c)
    {
      try
      {
        fits = conditions[c].Holds([&](std::size_t factor) { return ValueIn(k, factor); });
      }
      catch (const ExpressionError& error)
      {
        throw ConfigurationError(study.conditions[c].location, error.what());
      }
    }
    if (fits) points_.push_back(static_cast<std::uint32_t>(k));
    if (points_.size() * study.seeds.size() > kMostRuns)
      throw ConfigurationError(
          fmt::format("{}: the study has more than {} runs: take fewer values or seeds", study.name, kMostRuns));
  }
  if (points_.empty())
    throw ConfigurationError(
        study.conditions.front().location,
        fmt::format("none of {} combinations fulfils the conditions, so that there would be no runs", combinations));
}

std::vector<std::size_t> Design::LevelNumbers(std::uint64_t combination) const
{
  std::vector<std::size_t> of_dimension(study_.dimensions.size());
  for (std::size_t d = of_dimension.size(); d-- > 0;)
  {
    of_dimension[d] = combination % study_.dimensions[d].Size();
    combination /= study_.dimensions[d].Size();
  }
  return of_dimension;
}

std::vector<const FactorLevel*> Design::Levels(std::size_t point) const
{
  const std::vector<std::size_t> numbers = LevelNumbers(points_[point]);
  std::vector<const FactorLevel*> levels;
  for (std::size_t f = 0; f < factors_.size(); ++f) levels.push_back(&factors_[f]->levels[numbers[dimension_of_[f]]]);
  return levels;
}

StudySettings Design::SettingsOf(std::size_t point) const
{
  StudySettings settings;
  for (const StudyChange& change : study_.changes) settings.emplace_back(change.path, change.value);
  for (const FactorLevel* level : Levels(point))
    for (const StudyChange& change : level->changes) settings.emplace_back(change.path, change.value);
  if (study_.ticks != 0) settings.emplace_back("framework.maxclock", std::to_string(study_.ticks));
  return settings;
}

const std::string& Design::ExperimentOf(std::size_t point) const
{
  const std::string* experiment = &study_.experiment;
  for (const FactorLevel* level : Levels(point))
    if (!level->experiment.empty()) experiment = &level->experiment;
  return *experiment;
}

std::string Design::Text(std::size_t point) const
{
  std::string text;
  const std::vector<const FactorLevel*> levels = Levels(point);
  for (std::size_t f = 0; f < levels.size(); ++f)
    text += fmt::format("{}{}={}", f == 0 ? "" : " ", factors_[f]->id, levels[f]->value);
  return text;
}

ExpressionValue Design::ValueIn(std::uint64_t combination, std::size_t factor) const
{
  const std::size_t level = LevelNumbers(combination)[dimension_of_[factor]];
  const std::string& value = factors_[factor]->levels[level].value;
  if (factors_[factor]->is_numeric) return *ParseNumber(value);
  return value;
}

ExpressionValue Design::Value(std::size_t point, std::size_t factor) const { return ValueIn(points_[point], factor); }

std::vector<std::size_t> Design::PointsOfAllLevels(std::size_t most) const
{
  std::set<std::pair<std::size_t, std::size_t>> seen;
  std::vector<std::size_t> all;
  for (std::size_t p = 0; p < points_.size(); ++p)
  {
    const std::vector<std::size_t> numbers = LevelNumbers(points_[p]);
    bool is_new = p == 0;
    for (std::size_t d = 0; d < numbers.size(); ++d) is_new = seen.emplace(d, numbers[d]).second || is_new;
    if (is_new) all.push_back(p);
  }
  if (all.size() <= most) return all;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * (all.size() - 1) / (most - 1)]);
  return some;
}

std::vector<std::string> Design::ExperimentFiles() const
{
  std::set<std::string> files{study_.experiment};
  for (const Factor* factor : factors_)
    for (const FactorLevel& level : factor->levels)
      if (!level.experiment.empty()) files.insert(level.experiment);
  return {files.begin(), files.end()};
}

std::string Design::ExperimentsHash() const
{
  std::string texts;
  for (const std::string& file : ExperimentFiles()) texts += ReadTextFile(file);
  return fmt::format("{:016x}", XXH3_64bits(texts.data(), texts.size()));
}

}  // namespace swarmanoid
