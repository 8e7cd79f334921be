// A study file is read completely before anything runs: its mistakes are collected, with their places, so that users
// mend them in one go. Values that only look different (2 and 2.0) count as equal, because equal levels would compute
// the same runs twice. The number of runs is limited (kMostRuns) while levels and seeds are counted, so a slip such as
// 1-1000000000 does not fill the memory. Conditions are parsed with the names of the factors, so that their mistakes
// appear now and not in a run.
#include "studies/design/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/experiment/diagnostics.h"
#include "common/experiment/element_reader.h"
#include "common/program/shell_word.h"
#include "studies/design/factor_reader.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// Returns the same text for all spellings of a value: 2 and 2.0, or 1,2,0 and 1, 2, 0.
std::string ComparableValue(const std::string& value)
{
  std::string comparable;
  for (const std::string& word : SplitWords(value, kListed))
  {
    const auto number = ParseNumber(word);
    comparable += (number ? fmt::format("{}", *number + 0.0) : word) + ' ';
  }
  return comparable;
}

class StudyReader
{
public:
  StudyReader(Study& study, Diagnostics& diagnostics) : study_(study), diagnostics_(diagnostics), ids_(diagnostics) {}

  void Read(const TConfigurationTree& root)
  {
    const ElementReader reader(root, StudySchema(), diagnostics_);
    study_.experiment = ResolvedPath(study_.folder, reader.Text("experiment"));
    study_.ticks = static_cast<std::uint64_t>(reader.Integer("ticks"));
    study_.ticks_location = reader.Place("ticks");
    study_.seeds_location = reader.Place("seeds");
    study_.cluster = reader.Boolean("cluster");
    study_.controller_hosts = static_cast<unsigned>(reader.Integer("controller_hosts"));
    study_.visualisations = reader.Boolean("visualisations");
    ReadSeeds(reader);
    const bool is_search = root.Child("search").Exists();
    ReadDimensions(root, is_search);
    ReadMetrics(root.Child("metrics"));
    if (is_search) ReadSearch(root.Child("search"));
    CheckConditions();
    CheckSize(root.Location());
  }

private:
  void ReadDimensions(const TConfigurationTree& root, bool is_search)
  {
    FactorReader reader(study_.folder, is_search, ids_, diagnostics_);
    Dimension searched;
    for (const TConfigurationTree& child : root.Children())
    {
      if (child.Name() == "set") study_.changes.push_back(ReadSet(child, StudySchema().Child("set"), diagnostics_));
      if (child.Name() == "factor" || child.Name() == "variants")
        if (auto factor = reader.Read(child))
        {
          Dimension dimension{{std::move(*factor)}};
          if (dimension.factors[0].range)
            searched.factors.push_back(std::move(dimension.factors[0]));
          else
          {
            // The ids of <variants> are compared when they are read.
            if (child.Name() == "factor") CheckLevels(dimension);
            study_.dimensions.push_back(std::move(dimension));
          }
        }
      if (child.Name() == "zip")
        if (auto dimension = reader.ReadZip(child))
        {
          CheckLevels(*dimension);
          study_.dimensions.push_back(std::move(*dimension));
        }
      if (child.Name() == "require") ReadCondition(child);
    }
    if (!searched.factors.empty()) study_.dimensions.push_back(std::move(searched));
  }

  void ReadSeeds(const ElementReader& reader)
  {
    const auto fail = [&](const std::string& what)
    {
      diagnostics_.Add(reader.Place("seeds"),
                       fmt::format("'seeds' of <study> {}; write numbers and ranges, such as 1-30 or 1-10, 99", what));
    };
    for (const std::string& part : SplitWords(reader.Text("seeds"), kListed))
    {
      const std::size_t dash = part.find('-', 1);
      const auto first = ParseInteger(part.substr(0, dash));
      const auto last = dash == std::string::npos ? first : ParseInteger(part.substr(dash + 1));
      if (!first || !last || *first < 0 || *last < 0) return fail("holds " + Quoted(part));
      if (*last < *first) return fail(fmt::format("holds {}, a range that ends before it begins", Quoted(part)));
      if (static_cast<std::size_t>(*last - *first) >= kMostRuns || study_.seeds.size() > kMostRuns)
        return diagnostics_.Add(
            reader.Place("seeds"),
            fmt::format("'seeds' of <study> are more than {}, the most runs of a study", kMostRuns));
      for (long long seed = *first; seed <= *last; ++seed) study_.seeds.push_back(static_cast<std::uint64_t>(seed));
    }
    if (study_.seeds.empty()) return fail("are none");
    auto sorted = study_.seeds;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) fail(fmt::format("hold {} a second time", *twice));
  }

  void ReadSearch(const TConfigurationTree& tree)
  {
    ElementReader reader(tree, StudySchema().Child("search"), diagnostics_);
    SearchChoice search;
    search.location = tree.Location();
    search.column = reader.Text("metric");
    search.maximise = reader.Text("goal") == "max";
    search.aggregate = reader.Text("aggregate");
    search.runs = static_cast<std::uint64_t>(reader.Integer("runs"));
    search.algorithm = reader.Text("algorithm");
    search.population = static_cast<std::uint64_t>(reader.Integer("population"));
    search.tolerance = reader.Number("tolerance");
    search.patience = static_cast<std::uint64_t>(reader.Integer("patience"));
    search.random_seed = static_cast<std::uint64_t>(reader.Integer("random_seed"));
    search.fresh_seeds = static_cast<std::uint64_t>(reader.Integer("fresh_seeds"));
    CheckAggregates({search.aggregate}, reader);
    const std::vector<std::string> columns = MetricColumns(study_);
    if (reader.IsGood("metric") && std::find(columns.begin(), columns.end(), search.column) == columns.end())
      reader.Fail("metric", fmt::format("the <metrics> make no column {}; they make: {}{}", Quoted(search.column),
                                        Listed(columns), DidYouMean(search.column, columns)));
    if (search.algorithm != kRace && search.runs < study_.seeds.size())
      reader.Fail("runs", fmt::format("{} runs are less than one point takes, which has {} seeds", search.runs,
                                      study_.seeds.size()));
    std::size_t searched = 0;
    for (const Factor* factor : study_.Factors())
    {
      if (factor->range || (search.algorithm == kRace && factor->levels.size() > 1))
        ++searched;
      else if (factor->levels.size() > 1)
        diagnostics_.Add(factor->location,
                         fmt::format("a search goes through ranges of numbers, and {} has {} values: give it 'from' "
                                     "and 'to', or one value, or take algorithm=\"race\"",
                                     Quoted(factor->id), factor->levels.size()));
    }
    if (searched == 0)
      diagnostics_.Add(tree.Location(),
                       search.algorithm == kRace
                           ? "<search> has no <factor> with several values whose best one it could find"
                           : "<search> has no <factor> with 'from' and 'to' whose best value it could find");
    study_.search = std::move(search);
  }

  void ReadCondition(const TConfigurationTree& tree)
  {
    const ElementReader reader(tree, StudySchema().Child("require"), diagnostics_);
    if (reader.IsGood("condition")) study_.conditions.push_back({reader.Text("condition"), reader.Place("condition")});
  }

  void ReadMetrics(const TConfigurationTree& tree)
  {
    const ElementSpec& spec = StudySchema().Child("metrics");
    const ElementReader reader(tree, spec, diagnostics_);
    if (!tree.Exists()) return;
    study_.sample_every = static_cast<std::uint64_t>(reader.Integer("every"));
    for (const TConfigurationTree& child : tree.Children())
    {
      const ElementSpec* kind = spec.FindChild(child.Name());
      if (kind == nullptr) continue;
      const ElementReader metric(child, *kind, diagnostics_);
      MetricChoice choice{
          child.Name(),    ids_.Read(metric, "metric"), SplitWords(metric.Text("of"), kListed), {}, child,
          child.Location()};
      if (IsOfEachEntity(choice.kind) && !(choice.kind == "published" && metric.Text("by") == "functions"))
      {
        choice.aggregates = SplitWords(metric.Text("aggregate"), kListed);
        CheckAggregates(choice.aggregates, metric);
      }
      if (choice.kind == "in_region" || choice.kind == "time_to_region") CheckRegion(metric, child.Location());
      study_.metrics.push_back(std::move(choice));
    }
  }

  void CheckAggregates(const std::vector<std::string>& aggregates, const ElementReader& metric)
  {
    static const std::vector<std::string> kKnown{"mean", "deviation", "min", "max", "sum", "median", "count", "q25"};
    if (aggregates.empty())
      diagnostics_.Add(metric.Place("aggregate"), "'aggregate' names nothing; known: " + Listed(kKnown));
    for (std::size_t i = 0; i < aggregates.size(); ++i)
      if (std::find(aggregates.begin(), aggregates.begin() + static_cast<std::ptrdiff_t>(i), aggregates[i]) !=
          aggregates.begin() + static_cast<std::ptrdiff_t>(i))
        diagnostics_.Add(metric.Place("aggregate"),
                         fmt::format("'aggregate' names {} a second time, and would make two columns of one name",
                                     Quoted(aggregates[i])));
    for (const std::string& name : aggregates)
    {
      const auto quantile = name.starts_with("q") ? ParseInteger(name.substr(1)) : std::nullopt;
      if (quantile && *quantile >= 0 && *quantile <= 100) continue;
      if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end()) continue;
      diagnostics_.Add(metric.Place("aggregate"),
                       fmt::format("there is no aggregate {}; known: {} and other quantiles from q0 to q100{}",
                                   Quoted(name), Listed(kKnown), DidYouMean(name, kKnown)));
    }
  }

  void CheckRegion(const ElementReader& metric, const SourceLocation& place)
  {
    const bool disc = metric.IsGiven("centre") && metric.IsGiven("radius");
    const bool rectangle = metric.IsGiven("min") && metric.IsGiven("max");
    if (metric.IsGiven("entity") + disc + rectangle != 1)
      diagnostics_.Add(place, "a region is one of these: 'entity'; 'centre' and 'radius'; 'min' and 'max'");
  }

  void CheckConditions()
  {
    const std::vector<std::string> ids = study_.FactorIds();
    for (const StudyCondition& condition : study_.conditions)
    {
      try
      {
        const Expression checked(condition.text, ids);
      }
      catch (const ExpressionError& error)
      {
        diagnostics_.Add(condition.location, error.what());
      }
    }
  }

  // Two equal values of a factor, or of all factors of a <zip>, would repeat the same runs.
  void CheckLevels(const Dimension& dimension)
  {
    std::map<std::string, std::size_t> first_of;
    for (std::size_t k = 0; k < dimension.Size(); ++k)
    {
      std::string values, told;
      for (const Factor& factor : dimension.factors)
      {
        if (factor.range || k >= factor.levels.size()) return;
        const std::string& value = factor.levels[k].value;
        values += ComparableValue(value) + '\n';
        told += fmt::format("{}{}={}", told.empty() ? "" : " ", factor.id, value);
      }
      const auto [first, is_new] = first_of.try_emplace(values, k);
      if (is_new) continue;
      const FactorLevel& one = dimension.factors[0].levels[first->second];
      const FactorLevel& other = dimension.factors[0].levels[k];
      diagnostics_.Add(other.location,
                       fmt::format("value {} is {}, as is value {} at {}: their runs would be counted twice; leave one "
                                   "of the two out",
                                   k + 1, Quoted(told), first->second + 1, one.location.Text()));
      return;
    }
  }

  // The size is checked before objects of that size are made.
  void CheckSize(const SourceLocation& place)
  {
    double points = 1;
    for (const Dimension& dimension : study_.dimensions) points *= static_cast<double>(dimension.Size());
    const double most = static_cast<double>(kMostRuns) * (study_.conditions.empty() ? 1 : 10);
    const double runs = points * static_cast<double>(study_.conditions.empty() ? study_.seeds.size() : 1);
    if (runs > most)
      diagnostics_.Add(place, fmt::format("the study has {:g} {}; it may have {:g}: take fewer values or seeds", runs,
                                          study_.conditions.empty() ? "runs" : "points before its conditions", most));
  }

  Study& study_;
  Diagnostics& diagnostics_;
  StudyIds ids_;
};

LoadedStudy RefusedStudy(const ConfigurationError& error)
{
  LoadedStudy loaded;
  loaded.errors.push_back({error.Location(), error.Message()});
  return loaded;
}

}  // namespace

double StepsBetween(double from, double to, double step)
{
  const double steps = (to - from) / step;
  return std::floor(steps * (1 + 1e-12) + 1e-9);
}

std::vector<const Factor*> Study::Factors() const
{
  std::vector<const Factor*> factors;
  for (const Dimension& dimension : dimensions)
    for (const Factor& factor : dimension.factors) factors.push_back(&factor);
  return factors;
}

std::vector<std::string> Study::FactorIds() const
{
  std::vector<std::string> ids;
  for (const Factor* factor : Factors()) ids.push_back(factor->id);
  return ids;
}

LoadedStudy LoadStudyText(const std::string& text, const std::string& file_name, const std::string& folder)
{
  Diagnostics diagnostics;
  auto study = std::make_unique<Study>();
  study->name = fs::path(file_name).stem().string();
  study->folder = folder;
  study->text = text;
  try
  {
    const TConfigurationTree root(ReadXml(text, file_name));
    if (root.Name() != StudySchema().Name())
      throw ConfigurationError(
          root.Location(),
          fmt::format("the root element is <{}>; that of a study is <{}>{}", root.Name(), StudySchema().Name(),
                      root.Name() == "ahss-config" || root.Name() == "argos-configuration"
                          ? "; an experiment is run by: swarmanoid run " + ShellWord(file_name)
                          : ""));
    StudyReader(*study, diagnostics).Read(root);
  }
  catch (const ConfigurationError& error)
  {
    return RefusedStudy(error);
  }
  if (!diagnostics.Empty()) return {nullptr, diagnostics.Take()};
  return {std::move(study), {}};
}

LoadedStudy LoadStudyFile(const std::string& path)
{
  try
  {
    return LoadStudyText(ReadTextFile(path), path,
                         fs::absolute(fs::path(path)).parent_path().lexically_normal().string());
  }
  catch (const ConfigurationError& error)
  {
    return RefusedStudy(error);
  }
}

std::vector<std::string> MetricColumns(const Study& study)
{
  std::vector<std::string> columns;
  for (const MetricChoice& choice : study.metrics)
  {
    if (!choice.HasColumns()) continue;
    if (choice.aggregates.empty()) columns.push_back(choice.id);
    for (const std::string& aggregate : choice.aggregates) columns.push_back(choice.id + "." + aggregate);
  }
  return columns;
}

}  // namespace swarmanoid
