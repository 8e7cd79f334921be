#include "argos3/converter/convert.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "argos3/converter/convert_arena.h"
#include "argos3/converter/convert_code.h"
#include "argos3/converter/node_reader.h"
#include "common/activity/print_error.h"
#include "common/experiment/foreign_experiments.h"

namespace swarmanoid
{
namespace argos3
{
namespace
{

class Converter : NodeReader
{
public:
  Converter(const ConfigurationNode& root, const std::string& folder, ConvertedExperiment& result)
      : NodeReader(result), root_(root), folder_(folder), result_(result)
  {
  }

  // `bodies`: the result of a rehearsal. nullptr: the file is for a rehearsal, if one is needed, which is reported.
  bool Convert(const MadeBodies* bodies)
  {
    auto ours = MakeNode("ahss-config", root_.location);
    const ConfigurationNode* theirs = Needed(root_, "arena");
    if (theirs == nullptr) return false;
    ArenaConverter arena(*theirs, result_);
    if (bodies != nullptr) arena.KeepMadeBodies(*bodies);
    CodeConverter code(root_, folder_, arena, result_);
    ConvertFramework(*ours);
    const Made kinds = AddNode(*ours, "entity_kinds", root_.location);
    code.ConvertControllers(*ours);
    arena.Convert(*ours);
    for (const char* kind : {"argos3_epuck", kLitBox})
      if (arena.Kinds().contains(kind))
        SetValue(*AddNode(*kinds, kind, root_.location), "library", kind, root_.location);
    if (kinds->children.empty()) std::erase(ours->children, kinds);
    ConvertEngines(*ours, arena);
    const bool is_for_rehearsal = bodies == nullptr && code.MakesBodies();
    code.ConvertLoopFunctions(*ours, is_for_rehearsal);
    for (const auto& child : root_.children)
      if (child->name == "visualization")
      {
        if (!child->children.empty())
          Note(child->location, code.UserFunctions() == nullptr
                                    ? "<visualization> has no effect here; `swarmanoid attach` shows a run"
                                    : "of <visualization> the user functions alone have an effect here; "
                                      "`swarmanoid run --show web` shows the run");
      }
      else if (!kSections.contains(child->name))
        Mistake(child->location, "<" + child->name + "> has no counterpart; leave it out");
    result_.root = ours;
    return is_for_rehearsal;
  }

private:
  inline static const std::set<std::string> kSections{"framework",       "controllers", "arena",
                                                      "physics_engines", "media",       "loop_functions"};

  void ConvertFramework(ConfigurationNode& ours)
  {
    const ConfigurationNode* framework = Needed(root_, "framework");
    const ConfigurationNode* experiment = framework == nullptr ? nullptr : Needed(*framework, "experiment");
    if (experiment == nullptr) return;
    const SourceLocation& at = experiment->location;
    const Made made = AddNode(ours, "framework", at);
    NeededText(*experiment, "ticks_per_second");
    const long long ticks = Whole(*experiment, "ticks_per_second", 10);
    // It is rounded down, so that the ticks of a second stay the same whole number.
    const long long tick_ms = ticks < 1 || ticks > 1000 ? 0 : 1000 / ticks;
    const double missing = 1 - static_cast<double>(tick_ms * ticks) / 1000;
    constexpr double kMostMissing = 0.02;
    if (tick_ms == 0 || missing > kMostMissing)
      Mistake(at,
              "'ticks_per_second' is " + std::to_string(ticks) +
                  "; a tick has whole milliseconds here: 1, 2, 4, 5, 8, 10, 20, 25, 40, 50, 100, 125, 200, 250, 500 "
                  "or 1000 are possible");
    else
      SetValue(*made, "clocktick", std::to_string(tick_ms), at);
    if (tick_ms != 0 && missing > 0 && missing <= kMostMissing)
      Note(at, fmt::format("a tick has whole milliseconds here: {} ms, {:.1f} % less than 1/{} s", tick_ms,
                           100 * missing, ticks));
    const double length = Number(*experiment, "length", 0);
    constexpr double kMostTicks = 1e15;  // equal to the limit of <maxclock>
    // The negated condition also refuses NaN.
    if (!(length >= 0 && length * static_cast<double>(std::max(ticks, 1LL)) < kMostTicks))
      Mistake(FindAttributeOf(*experiment, "length")->location,
              "'length' of <experiment> is '" + NeededText(*experiment, "length") +
                  "'; it must be a number of seconds from 0 on, with at most 1e15 ticks; 0 is a run without an end");
    // The run has one tick more, before the first step of controllers.
    else if (length > 0)
      SetValue(*made, "maxclock", std::to_string(static_cast<long long>(length * static_cast<double>(ticks)) + 1), at);
    const long long seed = Whole(*experiment, "random_seed", 0);
    if (seed == 0) Note(at, "without a random_seed ARGoS3 takes the time; here it is 1, and --seed gives another one");
    SetValue(*made, "seed", std::to_string(seed == 0 ? 1 : seed), at);
    NoteOthers(*experiment, {"length", "ticks_per_second", "random_seed", "real_time"});
    if (const ConfigurationNode* profiling = FindChild(*framework, "profiling"))
      Note(profiling->location, "<profiling> has no effect here");
  }

  void ConvertEngines(ConfigurationNode& ours, const ArenaConverter& arena)
  {
    const ConfigurationNode* engines = Needed(root_, "physics_engines");
    if (engines == nullptr) return;
    const Made list = AddNode(ours, "engines", engines->location);
    const Made physics = AddNode(ours, "arena_physics", engines->location);
    std::map<std::string, std::string> made;  // by our engine: the id in ARGoS3
    for (const auto& theirs : engines->children)
    {
      const SourceLocation& at = theirs->location;
      const bool flat = theirs->name == "dynamics2d";
      if (!flat && theirs->name != "pointmass3d" && theirs->name != "dynamics3d")
      {
        Mistake(at,
                "the engine <" + theirs->name + "> has no counterpart; dynamics2d, pointmass3d and dynamics3d have");
        continue;
      }
      const std::string tag = flat ? "dynamics2d" : "dynamics3d";
      const std::string id = NeededText(*theirs, "id");
      if (!made.emplace(tag, id).second)
      {
        Note(at, "<" + theirs->name + "> of id '" + id + "' and the one before are one engine here");
        continue;
      }
      const Made engine = AddNode(*list, tag, at);
      SetValue(*engine, "id", id, at);
      if (flat) SetValue(*engine, "distance", TextOf(Number(*theirs, "elevation", 0) + arena.Origin().z()), at);
      NoteOthers(*theirs, {"id", "elevation", "iterations"});
      if (FindChild(*theirs, "boundaries") != nullptr)
        Note(FindChild(*theirs, "boundaries")->location, "<boundaries> have no effect here: one engine has all");
      if (theirs->name == "pointmass3d") Note(at, "<pointmass3d> is dynamics3d here: bodies that meet collide");
    }
    for (const auto& [tag, id] : made)
    {
      const Made binding = AddNode(*physics, "engine", engines->location);
      SetValue(*binding, "id", id, engines->location);
      for (const std::string& kind : arena.Kinds())
      {
        if (kind == "light_bulb") continue;
        // If both engines exist, eye-bots fly and foot-bots drive. Obstacles are in both.
        if (made.size() > 1 && (tag == "dynamics2d" ? kind == "eyebot" : kind == "footbot" || kind == "argos3_epuck"))
          continue;
        SetValue(*AddNode(*binding, "all", engines->location), "kind", kind, engines->location);
      }
    }
  }

  const ConfigurationNode& root_;
  const std::string& folder_;
  ConvertedExperiment& result_;
};

}  // namespace
}  // namespace argos3

ConvertedExperiment ConvertArgos3(const ConfigurationNode& root, const std::string& folder,
                                  const Argos3Rehearsal& rehearse, const ExperimentSettings& settings)
{
  ConvertedExperiment first;
  const bool is_for_rehearsal = argos3::Converter(root, folder, first).Convert(nullptr);
  if (!is_for_rehearsal || !first.mistakes.empty()) return first;
  const argos3::MadeBodies bodies = rehearse ? rehearse(*first.root, folder, settings) : argos3::MadeBodies();
  ConvertedExperiment result;
  argos3::Converter(root, folder, result).Convert(&bodies);
  return result;
}

void ReadArgos3Experiments(Argos3Rehearsal rehearse)
{
  AddExperimentConverter(
      "argos-configuration",
      [rehearse = std::move(rehearse)](const ConfigurationNode& root, const std::string& folder,
                                       const ExperimentSettings& settings, std::vector<Diagnostic>& mistakes)
      {
        ConvertedExperiment converted = ConvertArgos3(root, folder, rehearse, settings);
        for (const Diagnostic& note : converted.notes) PrintError("{}: note: {}\n", note.location.Text(), note.message);
        mistakes = std::move(converted.mistakes);
        return std::shared_ptr<const ConfigurationNode>(std::move(converted.root));
      });
}

}  // namespace swarmanoid
