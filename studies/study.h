// The study as read from its XML file: which experiment, what varies, how often each is repeated, what is measured.
// Plain values, checked; immutable after loading. docs/studies.md describes the file, docs/study_reference.md its
// elements.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/load_experiment.h"
#include "common/experiment/schema.h"
#include "studies/expression.h"

namespace swarmanoid
{

using StudySettings = std::vector<std::pair<std::string, std::string>>;  // as for --set: path and value

// One value of a factor.
struct FactorLevel
{
  std::string value;       // as in tables: "0.05", "kinematic"
  std::string experiment;  // of a variant that has a file of its own; empty: that of the study
  StudySettings settings;
};

struct Factor
{
  std::string id;
  std::vector<FactorLevel> levels;
  bool is_numeric = false;  // all values are numbers
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
  StudySettings settings;
  std::vector<Dimension> dimensions;
  std::vector<StudyCondition> conditions;
  std::uint64_t sample_every = 0;  // ticks; 0: at the last tick alone
  std::vector<MetricChoice> metrics;

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

// The most runs of a study.
inline constexpr std::size_t kMostRuns = 1'000'000;

// The table of study files: the reader, errors and docs/study_reference.md come from it.
const ElementSpec& StudySchema();
// Whether a kind of metric has a value for each entity, which aggregates make columns of.
bool IsOfEachEntity(const std::string& metric_kind);
// docs/study_reference.md: every element and parameter.
std::string StudyReference();

}  // namespace swarmanoid
