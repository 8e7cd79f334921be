// Ranges become lists of values here, so later code knows lists only. Values are computed from the start, not by
// repeated addition, so that the last one does not drift, and they are written with 12 digits. Ids become columns of
// tables; hence they must be names, differ, and not be one of the columns that every table has.
#include "studies/design/factor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kMostLevels = 1'000'000;

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

std::vector<std::string> EndsOf(const SearchRange& range)
{
  const double last =
      range.step > 0 ? range.from + StepsBetween(range.from, range.to, range.step) * range.step : range.to;
  return {fmt::format("{:.12g}", range.from), fmt::format("{:.12g}", last)};
}

}  // namespace

std::string ResolvedPath(const std::string& folder, const std::string& path)
{
  return path.empty() ? path : (fs::path(folder) / path).lexically_normal().string();
}

StudyChange ReadSet(const TConfigurationTree& tree, const ElementSpec& spec, Diagnostics& diagnostics)
{
  const ElementReader reader(tree, spec, diagnostics);
  return {reader.Text("path"), reader.Text("value"), tree.Location()};
}

StudyIds::StudyIds(Diagnostics& diagnostics) : diagnostics_(diagnostics)
{
  // These names have another meaning in tables.
  for (const char* taken : {"point", "seed", "tick", "time_s", "ticks", "exit", "hash"}) ids_[taken] = {};
}

std::string StudyIds::Read(const ElementReader& reader, const char* what)
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
            : fmt::format("the id {} is given a second time; the first is in line {}", Quoted(id), found->second.line));
  return id;
}

FactorReader::FactorReader(const std::string& folder, bool is_search, StudyIds& ids, Diagnostics& diagnostics)
    : folder_(folder), is_search_(is_search), ids_(ids), diagnostics_(diagnostics)
{
}

std::optional<Factor> FactorReader::Read(const TConfigurationTree& tree)
{
  Factor factor;
  factor.location = tree.Location();
  if (tree.Name() == "variants")
    ReadVariants(tree, factor);
  else
    ReadPaths(tree, factor);
  factor.is_numeric = std::all_of(factor.levels.begin(), factor.levels.end(),
                                  [](const FactorLevel& level) { return ParseNumber(level.value).has_value(); });
  if (!factor.levels.empty()) return factor;
  diagnostics_.Add(tree.Location(), fmt::format("<{}> {} has no values, so that there would be no runs", tree.Name(),
                                                Quoted(factor.id)));
  return std::nullopt;
}

void FactorReader::ReadVariants(const TConfigurationTree& tree, Factor& factor)
{
  const ElementReader reader(tree, StudySchema().Child("variants"), diagnostics_);
  factor.id = ids_.Read(reader, "factor");
  for (const TConfigurationTree& variant : tree.Children())
    if (variant.Name() == "variant") ReadVariant(variant, factor);
}

void FactorReader::ReadVariant(const TConfigurationTree& tree, Factor& factor)
{
  const ElementSpec& spec = StudySchema().Child("variants").Child("variant");
  const ElementReader reader(tree, spec, diagnostics_);
  FactorLevel level;
  level.location = tree.Location();
  level.value = reader.Text("id");
  level.experiment = ResolvedPath(folder_, reader.Text("experiment"));
  for (const TConfigurationTree& child : tree.Children())
    if (child.Name() == "set") level.changes.push_back(ReadSet(child, spec.Child("set"), diagnostics_));
  const auto same = [&](const FactorLevel& other) { return other.value == level.value; };
  const auto first = std::find_if(factor.levels.begin(), factor.levels.end(), same);
  if (first != factor.levels.end())
    diagnostics_.Add(reader.Place("id"), fmt::format("the variant {} is given a second time; the first is at {}",
                                                     Quoted(level.value), first->location.Text()));
  factor.levels.push_back(std::move(level));
}

void FactorReader::ReadPaths(const TConfigurationTree& tree, Factor& factor)
{
  const ElementReader reader(tree, StudySchema().Child("factor"), diagnostics_);
  factor.id = ids_.Read(reader, "factor");
  const std::vector<std::string> paths = SplitWords(reader.Text("path"), kListed);
  if (is_search_ && reader.IsGiven("from")) factor.range = ReadSearchRange(tree, reader);
  if (!factor.range && reader.IsGiven("start"))
    diagnostics_.Add(reader.Place("start"), "'start' is of a range that a <search> goes through");
  for (std::string& value : factor.range ? EndsOf(*factor.range) : ReadValues(tree, reader))
  {
    FactorLevel level;
    level.location = reader.IsGiven("values") ? reader.Place("values") : tree.Location();
    for (const std::string& path : paths) level.changes.push_back({path, value, tree.Location()});
    level.value = std::move(value);
    factor.levels.push_back(std::move(level));
  }
}

std::vector<std::string> FactorReader::ReadValues(const TConfigurationTree& tree, const ElementReader& reader)
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

std::vector<std::string> FactorReader::ReadRange(const TConfigurationTree& tree, const ElementReader& reader)
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
      diagnostics_.Add(reader.Place("step"), fmt::format("'step' {} does not lead from {} to {} in less than {} values",
                                                         step, from, to, kMostLevels));
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
    // Twelve digits are enough, and print 0.1 + 0.2 as 0.3 in tables.
    values.push_back(fmt::format("{:.12g}", value));
  }
  return values;
}

SearchRange FactorReader::ReadSearchRange(const TConfigurationTree& tree, const ElementReader& reader)
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

std::optional<Dimension> FactorReader::ReadZip(const TConfigurationTree& tree)
{
  const ElementReader reader(tree, StudySchema().Child("zip"), diagnostics_);
  Dimension dimension;
  for (const TConfigurationTree& child : tree.Children())
    if (child.Name() == "factor" || child.Name() == "variants")
      if (auto factor = Read(child)) dimension.factors.push_back(std::move(*factor));
  for (const Factor& factor : dimension.factors)
    if (factor.range)
      diagnostics_.Add(factor.location, "a search has no <zip>: several paths of one <factor> get the same value");
  if (dimension.factors.empty())
  {
    diagnostics_.Add(tree.Location(), "<zip> holds no factor, so that there would be no runs");
    return std::nullopt;
  }
  for (const Factor& factor : dimension.factors)
    if (factor.levels.size() != dimension.Size())
      diagnostics_.Add(
          factor.location,
          fmt::format("the factors of <zip> have equally many values, but {} has {} and {} has {}",
                      Quoted(dimension.factors[0].id), dimension.Size(), Quoted(factor.id), factor.levels.size()));
  return dimension;
}

}  // namespace swarmanoid
