// Problem: find two statements that set one value in the same run, although paths may be spelled differently and
// variants may choose other experiments.
//
// Method: for each experiment file, all paths are resolved to addresses of values, and statements are grouped by
// address. Two statements of a group conflict if one point has both: statements of all runs always meet, those of
// different levels of one factor never, others if the design has a point with both levels.
//
// Invariant: at most kMostConflicts conflicts are reported, each once.
#include "studies/design/conflicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "common/configuration/wording.h"
#include "common/experiment/settings.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostConflicts = 20;

// A statement of the study that sets a value: in all runs, or in those with one level of a factor.
struct Statement
{
  std::string path;  // empty: it sets the experiment file
  std::string text;  // "<set>", "'robots'"
  SourceLocation location;
  const Factor* factor = nullptr;
  const FactorLevel* level = nullptr;
};

class ConflictFinder
{
public:
  ConflictFinder(const Study& study, const Design& design) : design_(design), factors_(study.Factors())
  {
    for (const StudyChange& change : study.changes) statements_.push_back({change.path, "<set>", change.location});
    for (const Factor* factor : factors_) AddFactor(*factor);
    if (study.ticks != 0) statements_.push_back({"framework.maxclock", "'ticks' of <study>", study.ticks_location});
    statements_.push_back({"framework.seed", "'seeds' of <study>", study.seeds_location});
  }

  std::vector<std::string> Find()
  {
    FindTwo(ByAddress(nullptr), "");
    for (const std::string& file : design_.ExperimentFiles())
      if (const auto tree = ReadExperimentTree(file)) FindTwo(ByAddress(tree), file);
    return std::move(conflicts_);
  }

private:
  using Groups = std::map<std::string, std::vector<const Statement*>>;

  void AddFactor(const Factor& factor)
  {
    const std::string text = fmt::format("the factor {}", Quoted(factor.id));
    for (const FactorLevel& level : factor.levels)
    {
      const std::string variant = fmt::format("the variant {} of {}", Quoted(level.value), Quoted(factor.id));
      if (!level.experiment.empty()) statements_.push_back({"", variant, level.location, &factor, &level});
      for (const StudyChange& change : level.changes)
      {
        // A <factor> states its paths once, for all its values.
        const bool is_of_factor =
            change.location.line == factor.location.line && change.location.column == factor.location.column;
        if (is_of_factor && &level != &factor.levels[0]) return;
        statements_.push_back({change.path, is_of_factor ? text : "<set> of " + variant, change.location, &factor,
                               is_of_factor ? nullptr : &level});
      }
    }
  }

  // Returns the statements about each value of the experiment; without a tree, those that set the experiment file.
  Groups ByAddress(const std::shared_ptr<const ConfigurationNode>& tree) const
  {
    Groups groups;
    for (const Statement& statement : statements_)
    {
      if (statement.path.empty() != (tree == nullptr)) continue;
      try
      {
        groups[tree ? SettingAddress(tree, statement.path) : ""].push_back(&statement);
      }
      catch (const ConfigurationError&)
      {
        // The path does not exist in this experiment, which is reported when a run with it is tried.
      }
    }
    return groups;
  }

  void FindTwo(const Groups& groups, const std::string& experiment)
  {
    for (const auto& [address, statements] : groups)
      for (std::size_t j = 1; j < statements.size(); ++j)
        for (std::size_t i = 0; i < j && conflicts_.size() < kMostConflicts; ++i)
          if (MeetInARun(*statements[i], *statements[j], experiment)) Add(*statements[i], *statements[j]);
  }

  bool MeetInARun(const Statement& one, const Statement& other, const std::string& experiment) const
  {
    if (one.factor != nullptr && one.factor == other.factor && one.level != other.level) return false;
    for (std::size_t point = 0; point < design_.Points(); ++point)
    {
      if (!experiment.empty() && design_.ExperimentOf(point) != experiment) continue;
      const std::vector<const FactorLevel*> levels = design_.Levels(point);
      const auto is_here = [&](const Statement& statement)
      { return statement.level == nullptr || std::count(levels.begin(), levels.end(), statement.level) > 0; };
      if (is_here(one) && is_here(other)) return true;
    }
    return false;
  }

  void Add(const Statement& one, const Statement& other)
  {
    std::string text = one.path.empty()
                           ? fmt::format("{}: {} chooses the experiment of runs whose experiment {} at {} chooses, too",
                                         other.location.Text(), other.text, one.text, one.location.Text())
                           : fmt::format("{}: {} sets {}, which {} at {} sets, too{}", other.location.Text(),
                                         other.text, Quoted(other.path), one.text, one.location.Text(),
                                         one.path == other.path ? "" : fmt::format(" (as {})", Quoted(one.path)));
    text += "; leave one of the two out";
    if (std::find(conflicts_.begin(), conflicts_.end(), text) == conflicts_.end())
      conflicts_.push_back(std::move(text));
  }

  const Design& design_;
  const std::vector<const Factor*> factors_;
  std::vector<Statement> statements_;
  std::vector<std::string> conflicts_;
};

}  // namespace

std::vector<std::string> ConflictsIn(const Study& study, const Design& design)
{
  return ConflictFinder(study, design).Find();
}

}  // namespace swarmanoid
