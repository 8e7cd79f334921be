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

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/math/elementary.h"
#include "common/program/csv.h"
#include "common/program/interrupts.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "launcher/archive/picture_export.h"
#include "launcher/command/sub_command.h"
#include "launcher/supervision/progress_display.h"
#include "simulation/playback/export_file.h"
#include "simulation/playback/mcap_export.h"
#include "simulation/playback/recorded_run.h"
#include "space_server/event_log.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

const std::vector<std::string> kPoseColumns{"x", "y", "z", "alpha", "beta", "gamma"};

struct ExportOptions
{
  std::string run;
  std::string csv;
  std::string mcap;
  std::string html;
  std::string gif;
  std::string webm;
  std::vector<std::string> columns;  // none: kPoseColumns
  std::string entities = "*";
  std::uint64_t every = 0;              // 0: each tick, for films as few as make a short one
  std::vector<std::string> parameters;  // of the renderer of films, "name=value"
  std::uint64_t from = 0;
  std::optional<std::uint64_t> until;
};

// A column of the table: a value of an entity, or nothing if its kind does not have it.
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

// Returns the columns of these names. "led" means all of its elements, "led[3]" one of them.
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

// Appends the shortest text that reads back as the same bits.
void AppendExact(double value, std::string& line)
{
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  line.append(text, end);
}

bool IsWanted(const ExportOptions& options, std::uint64_t tick)
{
  const std::uint64_t every = std::max<std::uint64_t>(options.every, 1);
  return tick >= options.from && tick % every == 0 && (!options.until || tick <= *options.until);
}

// Calls `use` at each requested state.
void ForEachState(const ExportOptions& options, RecordedRun& run, const std::function<void()>& use)
{
  std::uint64_t states = 0;
  const std::uint64_t end = std::min(options.until.value_or(UINT64_MAX), run.LastTick()) + 1;
  std::optional<WorkProgress> progress;
  // Standard output may be the same terminal.
  if (options.csv != "-" && options.mcap != "-") progress.emplace("exporting", end - std::min(run.FirstTick(), end));
  while (!Interrupted() && run.Next())
  {
    const std::uint64_t tick = run.Space().GetTick();
    if (progress) progress->At(tick - run.FirstTick());
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

// Returns the option of the file and its name.
std::pair<std::string, std::string> FileOf(const ExportOptions& options)
{
  std::vector<std::pair<std::string, std::string>> given;
  for (const auto& [option, file] :
       {std::pair("--html", &options.html), std::pair("--gif", &options.gif), std::pair("--webm", &options.webm),
        std::pair("--csv", &options.csv), std::pair("--mcap", &options.mcap)})
    if (!file->empty()) given.emplace_back(option, *file);
  if (given.size() != 1)
    throw UsageError(
        "export: name one format and its file: --html run.html, --gif film.gif, --webm film.webm, --csv table.csv or "
        "--mcap run.mcap");
  return given.front();
}

void CheckOptions(const ExportOptions& options, const std::string& format)
{
  if (format != "--csv" && !options.columns.empty())
    throw UsageError("--columns: is of tables, --csv; " + format + " has poses and all attributes");
  const bool is_film = format == "--gif" || format == "--webm";
  if (!is_film && !options.parameters.empty())
    throw UsageError("--size, --camera and --speed are of films, --gif and --webm");
  if (format == "--csv" || format == "--mcap") return;
  if (options.entities != "*") throw UsageError("--entities: is of --csv and --mcap; " + format + " shows all");
}

// Writes a page or a film by a renderer.
void ExportPicture(const ExportOptions& options, RecordedRun& run, const std::string& format, const std::string& file)
{
  CheckNewFile(format, file);
  if (format != "--html" && fs::path(file).extension() != "." + format.substr(2))
    throw UsageError(fmt::format("{}: the name of the file must end in .{}", format, format.substr(2)));
  const std::uint64_t first = std::max(run.FirstTick(), options.from);
  const std::uint64_t last = std::min(run.LastTick(), options.until.value_or(UINT64_MAX));
  if (last < first || !run.SeekFrom(first))
    throw UsageError("no tick of the journal is among those that were asked for: see --from, --until, --every");
  std::vector<std::string> parameters =
      format == "--html"
          ? std::vector<std::string>{"file=" + file, fmt::format("every={}", std::max<std::uint64_t>(options.every, 1))}
          : FilmParameters(file, last + 1 - first, options.every, run.GetExperiment().TickSeconds());
  for (const std::string& given : options.parameters)
  {
    std::erase_if(parameters, [&](const std::string& own)
                  { return own.substr(0, own.find('=')) == given.substr(0, given.find('=')); });
    parameters.push_back(given);
  }
  parameters.push_back(fmt::format("from={}", first));
  PictureExport picture(run, format == "--html" ? "page" : "image", parameters);
  WorkProgress progress("exporting", last + 1 - first);
  bool more = true;
  for (; more && !Interrupted() && run.Space().GetTick() <= last; more = run.Next())
  {
    progress.At(run.Space().GetTick() - first);
    picture.Draw();
  }
  progress.Clear();
  picture.Finish();
  PrintError("{}: {} bytes, ticks {} to {}\n", file, fs::file_size(file), first, last);
}

int Export(const ExportOptions& options)
{
  RegisterBuiltins();
  CatchInterrupts();
  const auto [format, file] = FileOf(options);
  CheckOptions(options, format);
  RecordedRun run(std::filesystem::absolute(options.run).lexically_normal().string());
  PrintLoss(run.Loss());
  const CSwarmanoidSpace& space = run.Space();
  std::vector<std::size_t> entities;
  for (std::size_t k = 0; k < space.Size(); ++k)
    if (fnmatch(options.entities.c_str(), space.GetEntity(k).GetId().c_str(), FNM_NOESCAPE) == 0) entities.push_back(k);
  if (entities.empty())
    throw UsageError(fmt::format("--entities: no entity of the run matches {}", Quoted(options.entities)));
  bool is_whole = true;
  if (format == "--csv")
    ExportCsv(options, run, entities);
  else if (format != "--mcap")
    ExportPicture(options, run, format, file);
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
  verb->add_option("--html", options->html,
                   "One page that plays the run in any browser, without a server or a network, into a new file");
  verb->add_option("--gif", options->gif, "A film that repeats, for texts and slides, into a new file");
  verb->add_option("--webm", options->webm, "A film (VP9), into a new file");
  verb->add_option("--csv", options->csv, "A table of comma-separated values, into a new file; - is standard output");
  verb->add_option("--mcap", options->mcap, "Messages for Foxglove and rosbag2, into a new file; - is standard output");
  verb->add_option(
          "--columns", options->columns,
          "Of the table: x, y, z (m), alpha, beta, gamma (degrees), qx, qy, qz, qw, attributes as led, or elements as "
          "led[3]; otherwise the first six")
      ->delimiter(',');
  verb->add_option("--entities", options->entities,
                   "Only entities whose ids match: * stands for any characters, ? for one");
  verb->add_option("--every", options->every,
                   "Only ticks that are multiples of this; for films, ticks between two pictures, otherwise as many as "
                   "make a hundred pictures")
      ->check(CLI::Range(1.0, 1e15));
  verb->add_option("--from", options->from, "The first tick");
  verb->add_option("--until", options->until, "The last tick");
  const auto film = [&](const char* name, const char* text)
  {
    verb->add_option_function<std::string>(
        fmt::format("--{}", name),
        [options, name](const std::string& value) { options->parameters.push_back(fmt::format("{}={}", name, value)); },
        text);
  };
  film("size", "Of films: width and height in pixels, as 1280,720; otherwise 640,480");
  film("camera", "Of films: the number of a viewpoint, top, default, or x,y,z/heading,pitch,roll (m, degrees)");
  film("speed", "Of films: simulated seconds in a second; otherwise ten pictures a second");
  verb->footer(
      "A table has a line for each tick and entity that is in the arena, MCAP a message for each tick and topic: /tf,\n"
      "/scene, /attributes, /events. Their numbers are exact: they read back as the same bits. A page has positions "
      "to\n"
      "0.01 mm and directions to 0.006 degrees. `swarmanoid replay RUN image` has more options of films.\n"
      "Examples:\n"
      "  swarmanoid export runs/latest --html run.html\n"
      "  swarmanoid export runs/latest --gif film.gif --from 100 --until 300\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv poses.csv\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv leds.csv --columns x,y,led --entities 'fb_*' "
      "--every 10\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv - --from 100 --until 100\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --mcap run.mcap");
  verb->callback([options, &exit_code] { exit_code = Export(*options); });
}

const RegisterSubCommand kExport(6, "export", AddExportCommand);

}  // namespace
}  // namespace swarmanoid
