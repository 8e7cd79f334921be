// The study as read from its XML file: the experiment, the factors, the repetitions and the metrics. Plain values,
// checked; immutable after loading. docs/studies.md describes the file, docs/study_reference.md its elements.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/experiment/load_experiment.h"
#include "common/experiment/schema.h"
#include "studies/design/expression.h"

namespace swarmanoid
{

using StudySettings = std::vector<std::pair<std::string, std::string>>;  // path and value, as for --set

// A <set>, or one path of a <factor> with one of its values.
struct StudyChange
{
  std::string path;
  std::string value;
  SourceLocation location;
};

// One value of a factor.
struct FactorLevel
{
  std::string value;       // the text in tables: "0.05", "kinematic"
  std::string experiment;  // the file of a variant that has its own; empty: the study's file
  std::vector<StudyChange> changes;
  SourceLocation location;
};

// The values that a search may give to a factor: numbers between two ends.
struct SearchRange
{
  double from = 0;
  double to = 0;
  double step = 0;  // allows only from, from + step, from + 2 step …; 0: any number
  bool logarithmic = false;
  std::optional<double> start;
};

struct Factor
{
  std::string id;
  std::vector<FactorLevel> levels;   // for a searched factor: its ends
  std::optional<SearchRange> range;  // set for a searched factor
  bool is_numeric = false;           // all values are numbers
  SourceLocation location;
};

// Factors that vary together: one, or those of a <zip>, which must have equally many levels.
struct Dimension
{
  std::vector<Factor> factors;
  std::size_t Size() const { return factors.front().levels.size(); }
};

struct StudyCondition
{
  std::string text;
  SourceLocation location;
};

// One metric; docs/studies.md defines the kinds.
struct MetricChoice
{
  std::string kind;  // the tag
  std::string id;
  std::vector<std::string> of;          // ids or patterns of entities; empty: all robots
  std::vector<std::string> aggregates;  // for a metric with a value for each entity: "mean", "q25" …; else empty
  TConfigurationTree tree;              // the checked element of the metric
  SourceLocation location;

  bool HasColumns() const { return kind != "trajectories"; }
};

// <search>: finds the best values of the searched factors.
struct SearchChoice
{
  std::string column;  // a column of the table, at the end of the runs
  bool maximise = true;
  std::string aggregate;  // over a point's seeds: "mean", "q25" …
  std::uint64_t runs = 0;
  std::string algorithm;
  std::uint64_t population = 0;  // 0: the algorithm's default
  double tolerance = 0;          // for a local algorithm, relative to the ranges
  std::uint64_t patience = 0;    // points without an improvement that end the search; 0: no limit
  std::uint64_t random_seed = 1;
  std::uint64_t fresh_seeds = 0;
  SourceLocation location;
};

struct Study
{
  std::string name;    // the file's name, without folder and extension
  std::string folder;  // the file's folder, where relative paths start
  std::string text;    // the content of the file
  std::string experiment;
  std::uint64_t ticks = 0;  // 0: those of the experiment
  std::vector<std::uint64_t> seeds;
  bool cluster = false;
  unsigned controller_hosts = 1;
  bool visualisations = false;
  std::vector<StudyChange> changes;  // for all runs
  SourceLocation ticks_location, seeds_location;
  std::vector<Dimension> dimensions;
  std::vector<StudyCondition> conditions;
  std::uint64_t sample_every = 0;  // ticks; 0: only the last tick
  std::vector<MetricChoice> metrics;
  std::optional<SearchChoice> search;

  // Returns the ids in the order of the file, which is also the order of a point's values.
  std::vector<std::string> FactorIds() const;
  std::vector<const Factor*> Factors() const;
};

// Either a study or errors, each with its position.
struct LoadedStudy
{
  std::unique_ptr<Study> study;
  std::vector<Diagnostic> errors;
};

LoadedStudy LoadStudyFile(const std::string& path);
// Reads a study from a text. Relative paths start in `folder`.
LoadedStudy LoadStudyText(const std::string& text, const std::string& file_name, const std::string& folder);

// Returns the number of steps from one end of a range to the other. Rounding errors do not matter: steps of 0.1 from 0
// to 0.3 give 3.
double StepsBetween(double from, double to, double step);

// The largest number of runs of a study.
inline constexpr std::size_t kMostRuns = 1'000'000;

// Returns the table of study files, from which the reader, errors and docs/study_reference.md follow.
const ElementSpec& StudySchema();
// Returns whether a kind of metric has a value for each entity, so that its columns are aggregates.
bool IsOfEachEntity(const std::string& metric_kind);
// Returns the SI symbol of a metric's values; empty for a plain number. Values that users define state theirs.
std::string MetricUnit(const MetricChoice& choice);
// Returns the columns of the table except those that identify a run: "travelled.mean", "polarisation".
std::vector<std::string> MetricColumns(const Study& study);
// The algorithms that <search> may name. The first one is the default.
inline constexpr std::array kSearchAlgorithms = {"crs",    "isres",       "direct", "sbplx", "bobyqa",
                                                 "cobyla", "nelder_mead", "cma_es", "race"};
inline constexpr std::string_view kRace = "race";  // the one that compares runs, not points
// Returns docs/study_reference.md: every element and parameter.
std::string StudyReference();

}  // namespace swarmanoid
