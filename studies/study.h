// The study as read from its XML file: which experiment, what varies, how often each is repeated, what is measured.
// Plain values, checked; immutable after loading. docs/studies.md describes the file, docs/study_reference.md its
// elements.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/load_experiment.h"
#include "common/experiment/schema.h"
#include "studies/expression.h"

namespace swarmanoid
{

using StudySettings = std::vector<std::pair<std::string, std::string>>;  // as for --set: path and value

// One <set>, or one path of a <factor> with one of its values.
struct StudyChange
{
  std::string path;
  std::string value;
  SourceLocation location;
};

// One value of a factor.
struct FactorLevel
{
  std::string value;       // as in tables: "0.05", "kinematic"
  std::string experiment;  // of a variant that has a file of its own; empty: that of the study
  std::vector<StudyChange> changes;
  SourceLocation location;
};

// What a search may give to a factor: numbers between two ends.
struct SearchRange
{
  double from = 0;
  double to = 0;
  double step = 0;  // only from, from + step, from + 2 step …; 0: any number
  bool logarithmic = false;
  std::optional<double> start;
};

struct Factor
{
  std::string id;
  std::vector<FactorLevel> levels;   // of one that is searched: its ends
  std::optional<SearchRange> range;  // of one that is searched
  bool is_numeric = false;           // all values are numbers
  SourceLocation location;
};

// Factors that vary together: one, or those of a <zip>, which have equally many levels.
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

// One metric; docs/studies.md says what each kind measures.
struct MetricChoice
{
  std::string kind;  // the tag
  std::string id;
  std::vector<std::string> of;          // ids of entities, or patterns; empty: all robots
  std::vector<std::string> aggregates;  // of a metric that has a value for each entity: "mean", "q25" …; else empty
  TConfigurationTree tree;              // its element, checked
  SourceLocation location;
};

// <search>: which of the searched factors' values are the best.
struct SearchChoice
{
  std::string column;  // of the table, at the end of the runs
  bool maximise = true;
  std::string aggregate;  // of a point's seeds: "mean", "q25" …
  std::uint64_t runs = 0;
  std::string algorithm;
  std::uint64_t population = 0;  // 0: that of the algorithm
  double tolerance = 0;          // of a local algorithm, as a share of the ranges
  std::uint64_t patience = 0;    // points without a better one; 0: does not end it
  std::uint64_t random_seed = 1;
  std::uint64_t fresh_seeds = 0;
  SourceLocation location;
};

struct Study
{
  std::string name;    // that of the file, without folder and extension
  std::string folder;  // of the file: relative paths start here
  std::string text;    // of the file
  std::string experiment;
  std::uint64_t ticks = 0;  // 0: as the experiment says
  std::vector<std::uint64_t> seeds;
  bool cluster = false;
  unsigned controller_hosts = 1;
  bool visualisations = false;
  std::vector<StudyChange> changes;  // of all runs
  SourceLocation ticks_location, seeds_location;
  std::vector<Dimension> dimensions;
  std::vector<StudyCondition> conditions;
  std::uint64_t sample_every = 0;  // ticks; 0: at the last tick alone
  std::vector<MetricChoice> metrics;
  std::optional<SearchChoice> search;

  // Of all factors, in the order of the file; so are the values of a point.
  std::vector<std::string> FactorIds() const;
  std::vector<const Factor*> Factors() const;
};

// Either a study or errors, each with its place.
struct LoadedStudy
{
  std::unique_ptr<Study> study;
  std::vector<Diagnostic> errors;
};

LoadedStudy LoadStudyFile(const std::string& path);
// `folder`: relative paths start there.
LoadedStudy LoadStudyText(const std::string& text, const std::string& file_name, const std::string& folder);

// How many steps lead from one end of a range to the other. One of 0.1 from 0 to 0.3 has 3, whatever the last bits are.
double StepsBetween(double from, double to, double step);

// The most runs of a study.
inline constexpr std::size_t kMostRuns = 1'000'000;

// The table of study files: the reader, errors and docs/study_reference.md come from it.
const ElementSpec& StudySchema();
// Whether a kind of metric has a value for each entity, which aggregates make columns of.
bool IsOfEachEntity(const std::string& metric_kind);
// docs/study_reference.md: every element and parameter.
std::string StudyReference();

}  // namespace swarmanoid
