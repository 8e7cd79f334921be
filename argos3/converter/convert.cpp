// An experiment of ARGoS3 has to run here without a change. Its tree is converted to a tree of ours, section by
// section, and every difference that a user would notice becomes a note. A thing without a counterpart becomes a
// mistake, with the place in the user's file.
//
// Loop functions may create bodies while they start, and our engines need all bodies beforehand. So the file is
// converted twice if its library creates bodies: the first result is started once as a rehearsal, which reports the
// bodies that were created, and the second result reserves them. Every node keeps the location of the node from which
// it was made, so that later errors also point to the user's file.
#include "argos3/converter/convert.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "argos3/converter/convert_arena.h"
#include "argos3/converter/convert_code.h"
#include "argos3/converter/node_reader.h"
#include "argos3/converter/our_ids.h"
#include "argos3/converter/robot_rows.h"
#include "argos3/converter/tiny_xml.h"
#include "common/errors/print_error.h"
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

  // Converts the file. `bodies` is the result of a rehearsal. If it is nullptr, the file is for a rehearsal, if one is
  // needed, which is reported.
  bool Convert(const MadeBodies* bodies)
  {
    auto ours = MakeNode("ahss-config", root_.location);
    const ConfigurationNode* theirs = Needed(root_, "arena");
    if (theirs == nullptr) return false;
    ArenaConverter arena(*theirs, FindChild(root_, "controllers"), result_);
    if (bodies != nullptr) arena.KeepMadeBodies(*bodies);
    ReadGround(arena);
    if (FindChild(root_, "loop_functions") == nullptr) arena.PaintFloorWhite();
    if (const auto* engines = FindChild(root_, "physics_engines");
        engines != nullptr && FindChild(*engines, "pointmass3d"))
      arena.SetPointMasses();
    std::set<std::pair<std::string, std::string>> kinds_of_media;
    if (const ConfigurationNode* media = FindChild(root_, "media"))
      for (const auto& medium : media->children)
        if (const auto* id = FindAttributeOf(*medium, "id")) kinds_of_media.insert({medium->name, id->value});
    arena.SetMedia(kinds_of_media);
    CodeConverter code(root_, folder_, arena, result_, std::move(kinds_of_media));
    for (const char* section : {"controllers", "physics_engines"})
      if (const ConfigurationNode* node = FindChild(root_, section)) NoteOthers(*node, {});
    ConvertFramework(*ours);
    const Made kinds = AddNode(*ours, "entity_kinds", root_.location);
    code.ConvertControllers(*ours);
    arena.Convert(*ours);
    const auto add_library = [&](const std::string& kind)
    {
      if (arena.Kinds().contains(kind))
        SetValue(*AddNode(*kinds, kind, root_.location), "library", kind, root_.location);
    };
    for (const RobotRow& robot : RobotRows())
      if (robot.is_generic) add_library(std::string(robot.kind));
    add_library(kLitBox);
    if (kinds->children.empty()) std::erase(ours->children, kinds);
    ConvertEngines(*ours, arena);
    ReadMedia();
    const bool is_for_rehearsal = bodies == nullptr && code.MakesBodies();
    code.ConvertLoopFunctions(*ours, is_for_rehearsal);
    NoteOthers(root_, {});
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
    if (ticks < 1 || ticks > 1000)
      Mistake(at, "'ticks_per_second' is " + std::to_string(ticks) + "; it must be from 1 to 1000");
    else if (1000 % ticks == 0)
      SetValue(*made, "clocktick", std::to_string(1000 / ticks), at);
    else
      SetValue(*made, "ticks_per_second", std::to_string(ticks), at);
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
    if (Flag(*experiment, "real_time", false))
      Note(FindAttributeOf(*experiment, "real_time")->location,
           "'real_time': `swarmanoid run` keeps real time (--real-time F: another pace), not what `convert` writes");
    NoteOthers(*experiment, {"length", "ticks_per_second", "random_seed", "real_time"});
    NoteOthers(*framework, {});
    NoteOtherChildren(*framework, {"system", "experiment"});
    NoteOtherChildren(*experiment, {});
    if (const ConfigurationNode* system = FindChild(*framework, "system"))
    {
      if (Whole(*system, "threads", 0) != 0)
        Note(FindAttributeOf(*system, "threads")->location, "'threads' has no effect here; run with --threads N");
      NoteOthers(*system, {"threads"});
    }
  }

  // Besides ARGoS3's planar engine, our kinematic engine may be named in its place.
  static bool IsPlane(std::string_view engine)
  {
    return engine == "dynamics2d" || engine == "dummy_engine" || engine == "kinematics2d";
  }

  void ReadGround(ArenaConverter& arena)
  {
    const ConfigurationNode* engines = FindChild(root_, "physics_engines");
    if (engines == nullptr) return;
    const auto flat = std::ranges::find_if(engines->children, [](const auto& one) { return IsPlane(one->name); });
    if (flat == engines->children.end()) return;
    GroundFriction ground;
    if (const ConfigurationNode* friction = FindChild(**flat, "friction"))
    {
      const auto read = [&](const char* name, double& value)
      {
        value = Number(*friction, name, value);
        if (!(value >= 0))
          Mistake(friction->location, std::string("'") + name + "' of <friction> must not be negative");
      };
      read("box_linear_friction", ground.box_force);
      read("box_angular_friction", ground.box_torque);
      read("cylinder_linear_friction", ground.cylinder_force);
      read("cylinder_angular_friction", ground.cylinder_torque);
      NoteOthers(*friction, {"box_linear_friction", "box_angular_friction", "cylinder_linear_friction",
                             "cylinder_angular_friction"});
    }
    arena.SetGround(ground);
  }

  // Media exist only in ARGoS3: each device here finds what it senses itself.
  void ReadMedia()
  {
    const ConfigurationNode* media = FindChild(root_, "media");
    if (media == nullptr) return;
    NoteOthers(*media, {});
    bool has_led = false;
    for (const auto& medium : media->children)
    {
      const bool is_radio = medium->name == "range_and_bearing";
      NoteOtherChildren(*medium, {});
      const bool is_kilobots = medium->name == "kilobot_communication";
      NoteOthers(*medium, is_radio      ? std::set<std::string>{"id", "check_occlusions"}
                          : is_kilobots ? std::set<std::string>{"id", "message_drop_prob", "ignore_conflicts"}
                                        : std::set<std::string>{"id"});
      if (is_radio)
        Flag(*medium, "check_occlusions", true);
      else if (medium->name != "led" && !is_kilobots)
        Note(medium->location, "<" + medium->name + "> of <media> has no effect here");
      else if (!is_kilobots && std::exchange(has_led, true))
        Note(medium->location, "robots of several media <led> see each other here");
    }
  }

  void ConvertEngines(ConfigurationNode& ours, const ArenaConverter& arena)
  {
    const ConfigurationNode* engines = Needed(root_, "physics_engines");
    if (engines == nullptr) return;
    const Made list = AddNode(ours, "engines", engines->location);
    const Made physics = AddNode(ours, "arena_physics", engines->location);
    const bool have_volumes = std::ranges::any_of(
        engines->children, [](const auto& engine) { return FindChild(*engine, "boundaries") != nullptr; });
    std::vector<MadeEngine> made;
    for (const auto& theirs : engines->children)
    {
      const SourceLocation& at = theirs->location;
      const bool flat = IsPlane(theirs->name);
      if (!flat && theirs->name != "pointmass3d" && theirs->name != "dynamics3d")
      {
        Mistake(at, "the engine <" + theirs->name +
                        "> has no counterpart; dynamics2d, pointmass3d and dynamics3d have, and dummy_engine, the "
                        "kinematic engine of this simulator, may stand in their place");
        continue;
      }
      const bool is_rigid_plane = theirs->name == "dynamics2d";
      const std::string tag = flat ? theirs->name : "dynamics3d";
      const std::string id = OurCharacters(NeededText(*theirs, "id"));
      // Without boundaries the first engine of a kind has all entities.
      if (!have_volumes && std::ranges::any_of(made, [&](const MadeEngine& engine) { return engine.is_flat == flat; }))
      {
        Note(at, "<" + theirs->name + "> of id '" + id + "' and the one before are one engine here");
        continue;
      }
      const Made engine = AddNode(*list, tag, at);
      SetValue(*engine, "id", id, at);
      if (flat) SetValue(*engine, "distance", TextOf(Number(*theirs, "elevation", 0) + arena.Origin().z()), at);
      // The motors of ARGoS3's foot-bots, not their wheels, limit the force (dynamics2d_footbot_model.cpp).
      if (is_rigid_plane) SetValue(*engine, "wheel_friction", "1", at);
      if (is_rigid_plane) SetValue(*engine, "gripper", "rod", at);
      NoteOthers(*theirs, flat ? std::set<std::string>{"id", "elevation"} : std::set<std::string>{"id"});
      NoteOtherChildren(*theirs, is_rigid_plane ? std::set<std::string>{"boundaries", "friction"}
                                                : std::set<std::string>{"boundaries"});
      if (theirs->name == "pointmass3d") Note(at, "<pointmass3d> is dynamics3d here: bodies that meet collide");
      made.push_back({flat, id, FindChild(*theirs, "boundaries")});
    }
    const auto has = [&](bool flat)
    { return std::ranges::any_of(made, [&](const MadeEngine& engine) { return engine.is_flat == flat; }); };
    const bool has_both = has(true) && has(false);
    for (const MadeEngine& engine : made)
    {
      const Made binding = AddNode(*physics, "engine", engines->location);
      SetValue(*binding, "id", engine.id, engines->location);
      if (engine.boundaries != nullptr) ConvertBoundaries(*engine.boundaries, *binding, arena.Origin());
      for (const std::string& kind : arena.Kinds())
      {
        if (kind == "light_bulb") continue;
        // If both kinds of engines exist, some robots fly and the others drive. Obstacles are in all.
        if (has_both && (engine.is_flat ? Flies(kind) : !Flies(kind) && RobotOfKind(kind) != nullptr)) continue;
        SetValue(*AddNode(*binding, "all", engines->location), "kind", kind, engines->location);
      }
    }
  }

  // An engine of ours: the id and the boundaries in ARGoS3, nullptr for none.
  struct MadeEngine
  {
    bool is_flat;
    std::string id;
    const ConfigurationNode* boundaries;
  };

  static std::optional<Vector2> ParsePoint(std::string_view text)
  {
    const auto numbers = ParseNumbers(text);
    if (!numbers || numbers->size() != 2) return std::nullopt;
    return Vector2((*numbers)[0], (*numbers)[1]);
  }

  // ARGoS3's boundaries are a polygon of <sides>, counter-clockwise and convex, and heights.
  void ConvertBoundaries(const ConfigurationNode& boundaries, ConfigurationNode& ours, const Vector3& origin)
  {
    const SourceLocation& at = boundaries.location;
    NoteOthers(boundaries, {});
    NoteOtherChildren(boundaries, {"sides", "bottom", "top"});
    if (const ConfigurationNode* sides = FindChild(boundaries, "sides"))
    {
      std::string corners;
      std::size_t count = 0;
      for (const auto& vertex : sides->children)
      {
        if (vertex->name != "vertex") continue;
        NoteOthers(*vertex, {"point"});
        NeededText(*vertex, "point");
        const Vector2 corner =
            Parsed<Vector2>(*vertex, "point", Vector2::Zero(), ParsePoint, "two numbers with a comma between them") +
            origin.head<2>();
        corners += (corners.empty() ? "" : ", ") + TextOf(corner.x()) + ", " + TextOf(corner.y());
        ++count;
      }
      if (count < 3) return Mistake(sides->location, "the <sides> of <boundaries> need at least three <vertex>");
      SetValue(ours, "volume", corners, at);
    }
    const ConfigurationNode* bottom = FindChild(boundaries, "bottom");
    const ConfigurationNode* top = FindChild(boundaries, "top");
    for (const ConfigurationNode* height : {bottom, top})
      if (height != nullptr) NoteOthers(*height, {"height"});
    if (bottom == nullptr && top == nullptr) return;
    constexpr double kFar = 1e6;  // m
    const double low = bottom == nullptr ? -kFar : Number(*bottom, "height", 0) + origin.z();
    const double high = top == nullptr ? kFar : Number(*top, "height", 0) + origin.z();
    SetValue(ours, "heights", TextOf(low) + ", " + TextOf(high), at);
  }

  const ConfigurationNode& root_;
  const std::string& folder_;
  ConvertedExperiment& result_;
};

}  // namespace
}  // namespace argos3

namespace
{

// Returns each message once, in the order of the file, with all of its places.
std::vector<Diagnostic> Merged(std::vector<Diagnostic> all)
{
  const auto place = [](const Diagnostic& one) { return std::pair(one.location.line, one.location.column); };
  std::ranges::stable_sort(all, {}, place);
  std::map<std::string, std::set<std::pair<int, int>>> places;
  for (const Diagnostic& one : all) places[one.message].insert(place(one));
  std::vector<Diagnostic> merged;
  for (Diagnostic& one : all)
  {
    const auto found = places.find(one.message);
    if (found == places.end()) continue;
    found->second.erase(place(one));
    std::string more;
    constexpr std::size_t kMost = 5;
    for (std::size_t i = 0; const auto& [line, column] : found->second)
      if (i++ < kMost) more += fmt::format("{}{}:{}", more.empty() ? " (also at " : ", ", line, column);
    if (found->second.size() > kMost) more += fmt::format(" and {} other places", found->second.size() - kMost);
    places.erase(found);
    if (!more.empty()) one.message += more + ")";
    merged.push_back(std::move(one));
  }
  return merged;
}

}  // namespace

ConvertedExperiment ConvertArgos3(const ConfigurationNode& root, const std::string& folder,
                                  const Argos3Rehearsal& rehearse, const ExperimentSettings& settings)
{
  ConvertedExperiment first;
  const bool is_for_rehearsal = argos3::Converter(root, folder, first).Convert(nullptr);
  first.mistakes = Merged(std::move(first.mistakes));
  if (!is_for_rehearsal || !first.mistakes.empty()) return first;
  const argos3::MadeBodies bodies = rehearse ? rehearse(*first.root, folder, settings) : argos3::MadeBodies();
  ConvertedExperiment result;
  argos3::Converter(root, folder, result).Convert(&bodies);
  return result;
}

bool KeepsRealTime(const std::string& text)
{
  std::vector<Diagnostic> notes;
  const auto root = argos3::ReadTinyXml(text, "", notes);
  const ConfigurationNode* framework = root == nullptr ? nullptr : argos3::FindChild(*root, "framework");
  const ConfigurationNode* experiment = framework == nullptr ? nullptr : argos3::FindChild(*framework, "experiment");
  const auto* attribute = experiment == nullptr ? nullptr : argos3::FindAttributeOf(*experiment, "real_time");
  return attribute != nullptr && ParseBoolean(attribute->value).value_or(false);
}

void PrintNotes(const std::vector<Diagnostic>& notes)
{
  for (const Diagnostic& note : Merged(notes)) PrintError("{}: note: {}\n", note.location.Text(), note.message);
}

void ReadArgos3Experiments(Argos3Rehearsal rehearse)
{
  AddExperimentConverter(
      "argos-configuration",
      [rehearse = std::move(rehearse)](const ConfigurationNode& root, const std::string& folder,
                                       const ExperimentSettings& settings, std::vector<Diagnostic>& mistakes)
      {
        ConvertedExperiment converted = ConvertArgos3(root, folder, rehearse, settings);
        PrintNotes(converted.notes);
        mistakes = std::move(converted.mistakes);
        return std::shared_ptr<const ConfigurationNode>(std::move(converted.root));
      },
      [](const std::string& text, const std::string& file_name)
      {
        std::vector<Diagnostic> notes;
        auto root = argos3::ReadTinyXml(text, file_name, notes);
        PrintNotes(notes);
        return root;
      });
}

}  // namespace swarmanoid
