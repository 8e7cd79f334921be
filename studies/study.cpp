#include "studies/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/experiment/diagnostics.h"
#include "common/experiment/element_reader.h"
#include "studies/recorder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kMostLevels = 1'000'000;

constexpr std::string_view kListed = ", \t\r\n";

std::vector<std::string> ValuesIn(std::string_view text)
{
  return SplitWords(text, text.find(';') != std::string_view::npos ? ";" : kListed);
}

bool IsName(const std::string& id)
{
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !id.empty() && id.size() <= 64 && letter(id[0]) &&
         std::all_of(id.begin(), id.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

class StudyReader
{
public:
  StudyReader(Study& study, Diagnostics& diagnostics) : study_(study), diagnostics_(diagnostics) {}

  void Read(const TConfigurationTree& root)
  {
    const ElementReader reader(root, StudySchema(), diagnostics_);
    study_.experiment = Resolved(reader.Text("experiment"));
    study_.ticks = static_cast<std::uint64_t>(reader.Integer("ticks"));
    study_.cluster = reader.Boolean("cluster");
    study_.controller_hosts = static_cast<unsigned>(reader.Integer("controller_hosts"));
    study_.visualisations = reader.Boolean("visualisations");
    ReadSeeds(reader);
    // Names that are used in tables for something else.
    for (const char* taken : {"point", "seed", "tick", "time_s", "ticks", "exit", "hash"}) ids_[taken] = {};
    Dimension searched;
    is_search_ = root.Child("search").Exists();
    for (const TConfigurationTree& child : root.Children())
    {
      if (child.Name() == "set") study_.settings.push_back(ReadSet(child, StudySchema().Child("set")));
      if (child.Name() == "factor" || child.Name() == "variants")
      {
        Dimension dimension;
        ReadFactor(child, dimension);
        if (dimension.factors.empty()) continue;
        if (dimension.factors[0].range)
          searched.factors.push_back(std::move(dimension.factors[0]));
        else
          study_.dimensions.push_back(std::move(dimension));
      }
      if (child.Name() == "zip") ReadZip(child);
      if (child.Name() == "require") ReadCondition(child);
    }
    if (!searched.factors.empty()) study_.dimensions.push_back(std::move(searched));
    ReadMetrics(root.Child("metrics"));
    if (is_search_) ReadSearch(root.Child("search"));
    CheckConditions();
    CheckSize(root.Location());
  }

private:
  std::string Resolved(const std::string& path) const
  {
    return path.empty() ? path : (fs::path(study_.folder) / path).lexically_normal().string();
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

  std::pair<std::string, std::string> ReadSet(const TConfigurationTree& tree, const ElementSpec& spec)
  {
    const ElementReader reader(tree, spec, diagnostics_);
    return {reader.Text("path"), reader.Text("value")};
  }

  // Of factors and metrics: no name may be used twice.
  std::string ReadId(const ElementReader& reader, const char* what)
  {
    const std::string id = reader.Text("id");
    if (!reader.IsGood("id")) return id;
    if (!IsName(id))
      diagnostics_.Add(
          reader.Place("id"),
          fmt::format("the id {} of a {} must be letters, digits and '_', and begin with no digit", Quoted(id), what));
    const auto [found, is_new] = ids_.try_emplace(id, reader.Place("id"));
    if (!is_new)
      diagnostics_.Add(
          reader.Place("id"),
          found->second.line == 0
              ? fmt::format("the id {} is the name of a column of every table; choose another one", Quoted(id))
              : fmt::format("the id {} is given a second time; the first is in line {}", Quoted(id),
                            found->second.line));
    return id;
  }

  void ReadFactor(const TConfigurationTree& tree, Dimension& into)
  {
    Factor factor;
    factor.location = tree.Location();
    if (tree.Name() == "variants")
    {
      const ElementReader reader(tree, StudySchema().Child("variants"), diagnostics_);
      factor.id = ReadId(reader, "factor");
      for (const TConfigurationTree& variant : tree.Children())
        if (variant.Name() == "variant") ReadVariant(variant, factor);
    }
    else
    {
      const ElementReader reader(tree, StudySchema().Child("factor"), diagnostics_);
      factor.id = ReadId(reader, "factor");
      const std::vector<std::string> paths = SplitWords(reader.Text("path"), kListed);
      if (is_search_ && reader.IsGiven("from")) factor.range = ReadSearchRange(tree, reader);
      if (!factor.range && reader.IsGiven("start"))
        diagnostics_.Add(reader.Place("start"), "'start' is of a range that a <search> goes through");
      for (std::string& value : factor.range ? EndsOf(*factor.range) : ReadValues(tree, reader))
      {
        FactorLevel level;
        for (const std::string& path : paths) level.settings.emplace_back(path, value);
        level.value = std::move(value);
        factor.levels.push_back(std::move(level));
      }
    }
    factor.is_numeric = std::all_of(factor.levels.begin(), factor.levels.end(),
                                    [](const FactorLevel& level) { return ParseNumber(level.value).has_value(); });
    if (factor.levels.empty())
      diagnostics_.Add(tree.Location(), fmt::format("<{}> {} has no values, so that there would be no runs",
                                                    tree.Name(), Quoted(factor.id)));
    else
      into.factors.push_back(std::move(factor));
  }

  void ReadVariant(const TConfigurationTree& tree, Factor& factor)
  {
    const ElementSpec& spec = StudySchema().Child("variants").Child("variant");
    const ElementReader reader(tree, spec, diagnostics_);
    FactorLevel level;
    level.value = reader.Text("id");
    level.experiment = Resolved(reader.Text("experiment"));
    for (const TConfigurationTree& child : tree.Children())
      if (child.Name() == "set") level.settings.push_back(ReadSet(child, spec.Child("set")));
    const auto same = [&](const FactorLevel& other) { return other.value == level.value; };
    if (std::any_of(factor.levels.begin(), factor.levels.end(), same))
      diagnostics_.Add(reader.Place("id"), fmt::format("there is a second variant {}", Quoted(level.value)));
    factor.levels.push_back(std::move(level));
  }

  std::vector<std::string> ReadValues(const TConfigurationTree& tree, const ElementReader& reader)
  {
    if (reader.IsGiven("values") == reader.IsGiven("from"))
    {
      diagnostics_.Add(tree.Location(),
                       "<factor> takes either 'values', or a range: 'from', 'to', and 'step' or 'count'");
      return {"0"};
    }
    if (reader.IsGiven("values"))
    {
      for (const char* other : {"to", "step", "count"})
        if (reader.IsGiven(other))
          diagnostics_.Add(reader.Place(other),
                           fmt::format("'{}' is of a range, and the values are given; keep one", other));
      return ValuesIn(reader.Text("values"));
    }
    return ReadRange(tree, reader);
  }

  std::vector<std::string> ReadRange(const TConfigurationTree& tree, const ElementReader& reader)
  {
    const double from = reader.Number("from");
    const double to = reader.Number("to");
    const bool logarithmic = reader.Text("scale") == "logarithmic";
    if (!reader.IsGiven("to") || reader.IsGiven("step") == reader.IsGiven("count"))
    {
      diagnostics_.Add(tree.Location(), "a range of <factor> has 'from', 'to', and either 'step' or 'count'");
      return {"0"};
    }
    if (logarithmic && (reader.IsGiven("step") || from <= 0 || to <= 0))
    {
      diagnostics_.Add(reader.Place("scale"), "a logarithmic range has a count, and begins and ends above 0");
      return {"0"};
    }
    std::size_t count = static_cast<std::size_t>(reader.Integer("count"));
    const double step = reader.Number("step");
    if (reader.IsGiven("step"))
    {
      const double steps = step > 0 ? (to - from) / step : -1;
      if (steps < 0 || steps >= static_cast<double>(kMostLevels))
      {
        diagnostics_.Add(
            reader.Place("step"),
            fmt::format("'step' {} does not lead from {} to {} in less than {} values", step, from, to, kMostLevels));
        return {"0"};
      }
      count = static_cast<std::size_t>(StepsBetween(from, to, step)) + 1;
    }
    std::vector<std::string> values;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0;
      const double value = reader.IsGiven("step") ? from + static_cast<double>(i) * step
                           : logarithmic          ? from * std::pow(to / from, share)
                                                  : from + share * (to - from);
      // Twelve digits: 0.1 + 0.2 is 0.3 in tables.
      values.push_back(fmt::format("{:.12g}", value));
    }
    return values;
  }

  SearchRange ReadSearchRange(const TConfigurationTree& tree, const ElementReader& reader)
  {
    SearchRange range{reader.Number("from"), reader.Number("to"), reader.Number("step"),
                      reader.Text("scale") == "logarithmic", std::nullopt};
    const auto fail = [&](const char* name, const std::string& message)
    {
      diagnostics_.Add(reader.IsGiven(name) ? reader.Place(name) : tree.Location(), message);
      range = {0, 1, 0, false, std::nullopt};
    };
    if (reader.IsGiven("values") || reader.IsGiven("count"))
      fail(reader.IsGiven("values") ? "values" : "count",
           "a range of a <search> has 'from', 'to', and perhaps 'step'; it has no count and no values");
    else if (!(range.from < range.to))
      fail("to", fmt::format("the range from {} to {} of a <search> is empty", range.from, range.to));
    else if (range.logarithmic && range.from <= 0)
      fail("from", "a logarithmic range begins above 0");
    else if (reader.IsGiven("step") && !(range.step > 0 && StepsBetween(range.from, range.to, range.step) >= 1))
      fail("step", fmt::format("'step' {} does not lead from {} to another value", range.step, range.from));
    else if (reader.IsGiven("start"))
    {
      range.start = reader.Number("start");
      if (*range.start < range.from || *range.start > range.to)
        fail("start", fmt::format("'start' {} is not in the range from {} to {}", *range.start, range.from, range.to));
    }
    return range;
  }

  static std::vector<std::string> EndsOf(const SearchRange& range)
  {
    const double last =
        range.step > 0 ? range.from + StepsBetween(range.from, range.to, range.step) * range.step : range.to;
    return {fmt::format("{:.12g}", range.from), fmt::format("{:.12g}", last)};
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
    if (search.runs < study_.seeds.size())
      reader.Fail("runs", fmt::format("{} runs are less than one point takes, which has {} seeds", search.runs,
                                      study_.seeds.size()));
    std::size_t searched = 0;
    for (const Factor* factor : study_.Factors())
    {
      if (factor->range)
        ++searched;
      else if (factor->levels.size() > 1)
        diagnostics_.Add(factor->location,
                         fmt::format("a search goes through ranges of numbers, and {} has {} values: give it 'from' "
                                     "and 'to', or one value",
                                     Quoted(factor->id), factor->levels.size()));
    }
    if (searched == 0)
      diagnostics_.Add(tree.Location(), "<search> has no <factor> with 'from' and 'to' whose best value it could find");
    study_.search = std::move(search);
  }

  void ReadZip(const TConfigurationTree& tree)
  {
    const ElementReader reader(tree, StudySchema().Child("zip"), diagnostics_);
    Dimension dimension;
    for (const TConfigurationTree& child : tree.Children())
      if (child.Name() == "factor" || child.Name() == "variants") ReadFactor(child, dimension);
    for (const Factor& factor : dimension.factors)
      if (factor.range)
        diagnostics_.Add(factor.location, "a search has no <zip>: several paths of one <factor> get the same value");
    if (dimension.factors.empty())
      return diagnostics_.Add(tree.Location(), "<zip> holds no factor, so that there would be no runs");
    for (const Factor& factor : dimension.factors)
      if (factor.levels.size() != dimension.Size())
        diagnostics_.Add(
            factor.location,
            fmt::format("the factors of <zip> have equally many values, but {} has {} and {} has {}",
                        Quoted(dimension.factors[0].id), dimension.Size(), Quoted(factor.id), factor.levels.size()));
    study_.dimensions.push_back(std::move(dimension));
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
      MetricChoice choice{child.Name(), ReadId(metric, "metric"), SplitWords(metric.Text("of"), kListed), {},
                          child,        child.Location()};
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

  // Before anything of that size is made.
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
  std::map<std::string, SourceLocation> ids_;
  bool is_search_ = false;
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
      throw ConfigurationError(root.Location(), fmt::format("the root element is <{}>; that of a study is <{}>",
                                                            root.Name(), StudySchema().Name()));
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

}  // namespace swarmanoid
