// `swarmanoid export`: writes the content of a run's journal for other tools.
#include <fmt/format.h>
#include <fnmatch.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/configuration/wording.h"
#include "common/math/elementary.h"
#include "common/program/csv.h"
#include "common/program/interrupts.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "launcher/command/sub_command.h"
#include "simulation/playback/export_file.h"
#include "simulation/playback/mcap_export.h"
#include "simulation/playback/recorded_run.h"
#include "space_server/event_log.h"

namespace swarmanoid
{
namespace
{

const std::vector<std::string> kPoseColumns{"x", "y", "z", "alpha", "beta", "gamma"};

struct ExportOptions
{
  std::string run;
  std::string csv;
  std::string mcap;
  std::vector<std::string> columns;  // none: kPoseColumns
  std::string entities = "*";
  std::uint64_t every = 1;
  std::uint64_t from = 0;
  std::optional<std::uint64_t> until;
};

// The value of an entity; nothing if its kind has none.
struct ExportColumn
{
  std::string name;
  std::function<std::optional<double>(const CSwarmanoidSpaceEntity&)> value;
};

std::vector<ExportColumn> ColumnsOfPoses()
{
  using Entity = CSwarmanoidSpaceEntity;
  const auto angle = [](double EulerAngles::*member)
  {
    return [member](const Entity& e)
    { return std::optional(RadiansToDegrees(EulerFromQuaternion(e.GetOrientation()).*member)); };
  };
  return {
      {"x", [](const Entity& e) { return std::optional(e.GetPosition().x()); }},
      {"y", [](const Entity& e) { return std::optional(e.GetPosition().y()); }},
      {"z", [](const Entity& e) { return std::optional(e.GetPosition().z()); }},
      {"alpha", angle(&EulerAngles::alpha)},
      {"beta", angle(&EulerAngles::beta)},
      {"gamma", angle(&EulerAngles::gamma)},
      {"qx", [](const Entity& e) { return std::optional(e.GetOrientation().x()); }},
      {"qy", [](const Entity& e) { return std::optional(e.GetOrientation().y()); }},
      {"qz", [](const Entity& e) { return std::optional(e.GetOrientation().z()); }},
      {"qw", [](const Entity& e) { return std::optional(e.GetOrientation().w()); }},
  };
}

// Returns the attributes of all kinds in the space, with their numbers of elements.
std::vector<std::pair<std::string, int>> AttributesIn(const CSwarmanoidSpace& space)
{
  std::vector<std::pair<std::string, int>> attributes;
  for (std::size_t k = 0; k < space.Size(); ++k)
    for (const AttributeSpec& spec : AttributesOf(space.GetEntity(k).GetKind()))
    {
      const auto known = std::find_if(attributes.begin(), attributes.end(),
                                      [&](const auto& attribute) { return attribute.first == spec.name; });
      if (known == attributes.end())
        attributes.emplace_back(spec.name, spec.count);
      else
        known->second = std::max(known->second, spec.count);
    }
  return attributes;
}

ExportColumn ElementColumn(const CSwarmanoidSpace& space, const std::string& attribute, int element)
{
  return {fmt::format("{}[{}]", attribute, element),
          [&space, attribute, element](const CSwarmanoidSpaceEntity& entity) -> std::optional<double>
          {
            const AttributeSpec* spec = FindAttribute(entity.GetKind(), attribute);
            if (spec == nullptr || element >= spec->count) return std::nullopt;
            return space.Attributes()[entity.SlotOf(attribute, element)];
          }};
}

// "led" is all of its elements, "led[3]" one of them.
std::vector<ExportColumn> ColumnsOf(const CSwarmanoidSpace& space, const std::vector<std::string>& names)
{
  const std::vector<ExportColumn> poses = ColumnsOfPoses();
  const auto attributes = AttributesIn(space);
  std::vector<std::string> known;
  for (const ExportColumn& column : poses) known.push_back(column.name);
  for (const auto& [name, count] : attributes) known.push_back(name);
  std::vector<ExportColumn> columns;
  for (const std::string& wanted : names)
  {
    const auto pose =
        std::find_if(poses.begin(), poses.end(), [&](const ExportColumn& column) { return column.name == wanted; });
    if (pose != poses.end())
    {
      columns.push_back(*pose);
      continue;
    }
    bool found = false;
    for (const auto& [name, count] : attributes)
      for (int element = 0; element < count; ++element)
      {
        ExportColumn column = ElementColumn(space, name, element);
        if (wanted != name && wanted != column.name) continue;
        columns.push_back(std::move(column));
        found = true;
      }
    if (!found)
      throw UsageError(fmt::format("--columns: there is no column {}; the run has: {}, or one element as led[3]{}",
                                   Quoted(wanted), Listed(known), DidYouMean(wanted, known)));
  }
  return columns;
}

// The shortest text that reads back as the same bits.
void AppendExact(double value, std::string& line)
{
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  line.append(text, end);
}

bool IsWanted(const ExportOptions& options, std::uint64_t tick)
{
  return tick >= options.from && tick % options.every == 0 && (!options.until || tick <= *options.until);
}

// Calls `use` at each state that is wanted.
void ForEachState(const ExportOptions& options, RecordedRun& run, const std::function<void()>& use)
{
  std::uint64_t states = 0;
  while (!Interrupted() && run.Next())
  {
    const std::uint64_t tick = run.Space().GetTick();
    if (options.until && tick > *options.until) break;
    if (!IsWanted(options, tick)) continue;
    ++states;
    use();
  }
  if (states == 0 && !Interrupted())
    throw UsageError("no tick of the journal is among those that were asked for: see --from, --until, --every");
}

void ExportCsv(const ExportOptions& options, RecordedRun& run, const std::vector<std::size_t>& entities)
{
  const CSwarmanoidSpace& space = run.Space();
  const std::vector<ExportColumn> columns = ColumnsOf(space, options.columns.empty() ? kPoseColumns : options.columns);
  ExportFile table("--csv", options.csv);
  std::string text = "tick,time_s,entity,kind";
  for (const ExportColumn& column : columns) text += "," + column.name;
  text += "\n";
  table.Write(text);
  ForEachState(options, run,
               [&]
               {
                 const std::uint64_t tick = space.GetTick();
                 text.clear();
                 for (const std::size_t k : entities)
                 {
                   if (!space.IsPresent(static_cast<std::uint32_t>(k))) continue;
                   const CSwarmanoidSpaceEntity& entity = space.GetEntity(k);
                   text += fmt::format("{},", tick);
                   AppendExact(static_cast<double>(tick) * space.GetTickSeconds(), text);
                   text += fmt::format(",{},{}", CsvField(entity.GetId()), TagName(entity.GetKind()));
                   for (const ExportColumn& column : columns)
                   {
                     text += ',';
                     if (const auto value = column.value(entity)) AppendExact(*value, text);
                   }
                   text += '\n';
                 }
                 table.Write(text);
               });
  table.Close();
}

// Returns false if some events cannot be read, which standard error says.
bool ExportMcap(const ExportOptions& options, RecordedRun& run, std::vector<std::size_t> entities)
{
  const EventLines events = ReadEventLines(run.Folder() + "/events.csv");
  for (const std::string& damaged : events.damaged) PrintError("{}\n", damaged);
  ExportFile file("--mcap", options.mcap);
  McapExport mcap(file, run.Space(), std::move(entities));
  auto next = events.lines.begin();
  const auto write_events_before = [&](std::uint64_t tick)
  {
    for (; next != events.lines.end() && next->tick < tick; ++next)
      if (next->tick >= options.from && (!options.until || next->tick <= *options.until)) mcap.WriteEvent(next->text);
  };
  ForEachState(options, run,
               [&]
               {
                 write_events_before(run.Space().GetTick());
                 mcap.WriteTick();
               });
  write_events_before(UINT64_MAX);
  mcap.Finish();
  file.Close();
  return events.damaged.empty();
}

int Export(const ExportOptions& options)
{
  RegisterBuiltins();
  CatchInterrupts();
  if (options.csv.empty() == options.mcap.empty())
    throw UsageError(
        "export: name one format and its file, as --csv table.csv or --mcap run.mcap; - is standard output");
  if (!options.mcap.empty() && !options.columns.empty())
    throw UsageError("--columns: is of tables, --csv; --mcap has poses and all attributes");
  RecordedRun run(std::filesystem::absolute(options.run).lexically_normal().string());
  PrintLoss(run.Loss());
  const CSwarmanoidSpace& space = run.Space();
  std::vector<std::size_t> entities;
  for (std::size_t k = 0; k < space.Size(); ++k)
    if (fnmatch(options.entities.c_str(), space.GetEntity(k).GetId().c_str(), FNM_NOESCAPE) == 0) entities.push_back(k);
  if (entities.empty())
    throw UsageError(fmt::format("--entities: no entity of the run matches {}", Quoted(options.entities)));
  bool is_whole = true;
  if (options.mcap.empty())
    ExportCsv(options, run, entities);
  else
    is_whole = ExportMcap(options, run, std::move(entities));
  if (Interrupted()) return kExitInterrupted;
  return run.ExitCode(is_whole ? kExitDone : kExitProcessFailed);
}

void AddExportCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ExportOptions>();
  CLI::App* verb = app.add_subcommand("export", "Write what the journal of a run has for other tools");
  verb->add_option("RUN", options->run, "The folder of a run as a cluster")->required();
  verb->add_option("--csv", options->csv, "A table of comma-separated values, into a new file; - is standard output");
  verb->add_option("--mcap", options->mcap, "Messages for Foxglove and rosbag2, into a new file; - is standard output");
  verb->add_option(
          "--columns", options->columns,
          "Of the table: x, y, z (m), alpha, beta, gamma (degrees), qx, qy, qz, qw, attributes as led, or elements as "
          "led[3]; otherwise the first six")
      ->delimiter(',');
  verb->add_option("--entities", options->entities,
                   "Only entities whose ids match: * stands for any characters, ? for one");
  verb->add_option("--every", options->every, "Only ticks that are multiples of this")->check(CLI::Range(1.0, 1e15));
  verb->add_option("--from", options->from, "The first tick");
  verb->add_option("--until", options->until, "The last tick");
  verb->footer(
      "A table has a line for each tick and entity that is in the arena, MCAP a message for each tick and topic: /tf,\n"
      "/scene, /attributes, /events. Numbers are exact: they read back as the same bits.\n"
      "Examples:\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv poses.csv\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv leds.csv --columns x,y,led --entities 'fb_*' "
      "--every 10\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv - --from 100 --until 100\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --mcap run.mcap");
  verb->callback([options, &exit_code] { exit_code = Export(*options); });
}

const RegisterSubCommand kExport(6, AddExportCommand);

}  // namespace
}  // namespace swarmanoid
