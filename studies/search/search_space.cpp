// Maps each side of the unit cube to the range of a factor: linear, logarithmic, or in steps. A linear range of n steps
// has n + 1 values with equal parts of the side, as has a list of n + 1 values. Values are rounded to twelve digits, as
// their texts have, so that equal points have equal texts.
#include "studies/search/search_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace swarmanoid
{
namespace
{

std::string TextOfValue(const ExpressionValue& value)
{
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.12g}", *number);
  return std::get<std::string>(value);
}

double StepsOf(const SearchRange& range) { return StepsBetween(range.from, range.to, range.step) + 1; }

double ValueAt(const SearchRange& range, double share)
{
  const double clipped = std::clamp(share, 0.0, 1.0);
  double value = range.logarithmic ? range.from * std::pow(range.to / range.from, clipped)
                                   : range.from + clipped * (range.to - range.from);
  if (range.step > 0)
  {
    // Each value of a linear range has an equal part of the side.
    const double last = StepsOf(range) - 1;
    const double number =
        range.logarithmic ? std::round((value - range.from) / range.step) : std::floor(clipped * StepsOf(range));
    value = range.from + std::min(number, last) * range.step;
  }
  return *ParseNumber(fmt::format("{:.12g}", value));
}

double ShareOf(const SearchRange& range, double value)
{
  if (range.logarithmic) return std::log(value / range.from) / std::log(range.to / range.from);
  if (range.step > 0) return (std::round((value - range.from) / range.step) + 0.5) / StepsOf(range);
  return (value - range.from) / (range.to - range.from);
}

ExpressionValue ValueOfLevel(const Factor& factor, std::size_t level)
{
  const std::string& text = factor.levels[level].value;
  return factor.is_numeric ? ExpressionValue(*ParseNumber(text)) : ExpressionValue(text);
}

// Returns the level with this value. Values of an older file that the factor no longer has give the first one.
const FactorLevel& LevelOf(const Factor& factor, const ExpressionValue& value)
{
  for (std::size_t level = 0; level < factor.levels.size(); ++level)
    if (ValueOfLevel(factor, level) == value) return factor.levels[level];
  return factor.levels.front();
}

}  // namespace

SearchSpace::SearchSpace(const Study& study) : study_(study), factors_(study.Factors())
{
  for (std::size_t f = 0; f < factors_.size(); ++f)
    if (factors_[f]->range || factors_[f]->levels.size() > 1) searched_.push_back(f);
  const std::vector<std::string> ids = study.FactorIds();
  for (const StudyCondition& condition : study.conditions) conditions_.emplace_back(condition.text, ids);
}

std::vector<double> SearchSpace::Start() const
{
  std::vector<double> start;
  for (const std::size_t f : searched_)
  {
    if (!factors_[f]->range)
    {
      start.push_back(0.5 / static_cast<double>(factors_[f]->levels.size()));
      continue;
    }
    const SearchRange& range = *factors_[f]->range;
    start.push_back(range.start ? ShareOf(range, *range.start) : 0.5);
  }
  return start;
}

std::vector<std::size_t> SearchSpace::Levels() const
{
  std::vector<std::size_t> levels;
  for (const std::size_t f : searched_) levels.push_back(factors_[f]->range ? 0 : factors_[f]->levels.size());
  return levels;
}

std::vector<ExpressionValue> SearchSpace::Values(std::span<const double> place) const
{
  std::vector<ExpressionValue> values;
  std::size_t side = 0;
  for (const Factor* factor : factors_)
  {
    if (factor->range)
      values.emplace_back(ValueAt(*factor->range, place[side++]));
    else
    {
      const std::size_t count = factor->levels.size();
      const auto level = count > 1 ? static_cast<std::size_t>(place[side++] * static_cast<double>(count)) : 0;
      values.push_back(ValueOfLevel(*factor, std::min(level, count - 1)));
    }
  }
  return values;
}

bool SearchSpace::Allows(const std::vector<ExpressionValue>& values) const
{
  for (std::size_t c = 0; c < conditions_.size(); ++c)
  {
    try
    {
      if (!conditions_[c].Holds([&](std::size_t factor) { return values[factor]; })) return false;
    }
    catch (const ExpressionError& error)
    {
      throw ConfigurationError(study_.conditions[c].location, error.what());
    }
  }
  return true;
}

const std::string& SearchSpace::Experiment(const std::vector<ExpressionValue>& values) const
{
  const std::string* experiment = &study_.experiment;
  for (std::size_t f = 0; f < factors_.size(); ++f)
    if (!factors_[f]->range)
      if (const FactorLevel& level = LevelOf(*factors_[f], values[f]); !level.experiment.empty())
        experiment = &level.experiment;
  return *experiment;
}

StudySettings SearchSpace::Settings(const std::vector<ExpressionValue>& values) const
{
  StudySettings settings;
  for (const StudyChange& change : study_.changes) settings.emplace_back(change.path, change.value);
  for (std::size_t f = 0; f < factors_.size(); ++f)
    for (const StudyChange& change :
         factors_[f]->range ? factors_[f]->levels[0].changes : LevelOf(*factors_[f], values[f]).changes)
      settings.emplace_back(change.path, factors_[f]->range ? TextOfValue(values[f]) : change.value);
  if (study_.ticks != 0) settings.emplace_back("framework.maxclock", std::to_string(study_.ticks));
  return settings;
}

std::string SearchSpace::Text(const std::vector<ExpressionValue>& values) const
{
  std::string text;
  for (std::size_t f = 0; f < factors_.size(); ++f)
    text += fmt::format("{}{}={}", f == 0 ? "" : " ", factors_[f]->id, TextOfValue(values[f]));
  return text;
}

}  // namespace swarmanoid
