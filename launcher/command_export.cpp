// `swarmanoid export`: what the journal of a run has, as a table for other tools.
#include <fmt/format.h>
#include <fnmatch.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/activity/exit_codes.h"
#include "common/configuration/wording.h"
#include "common/math/elementary.h"
#include "common/program/csv.h"
#include "common/program/interrupts.h"
#include "common/space/attributes.h"
#include "launcher/commands.h"
#include "launcher/recorded_run.h"

namespace swarmanoid
{
namespace
{

struct ExportOptions
{
  std::string run;
  std::string file;
  std::vector<std::string> columns;
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

// Of all kinds in the space, with their numbers of elements.
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

// A file that is not there yet, or standard output.
class ExportTable
{
public:
  explicit ExportTable(const std::string& path)
      : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wxe"))
  {
    if (file_ != nullptr) return;
    if (errno == EEXIST) throw UsageError(fmt::format("--csv: the file '{}' is there already; name another one", path));
    throw UsageError(fmt::format("--csv: cannot write '{}': {}", path, std::strerror(errno)));
  }
  ~ExportTable()
  {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  }
  ExportTable(const ExportTable&) = delete;
  ExportTable& operator=(const ExportTable&) = delete;

  void Write(const std::string& text)
  {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) Fail();
  }
  void Close()
  {
    const bool good = file_ == stdout ? std::fflush(file_) == 0 : std::fclose(file_) == 0;
    file_ = nullptr;
    if (!good) Fail();
  }

private:
  [[noreturn]] void Fail() const
  {
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
  }

  std::string path_;
  std::FILE* file_;
};

// The shortest text that reads back as the same bits.
void AppendExact(double value, std::string& line)
{
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  line.append(text, end);
}

int Export(const ExportOptions& options)
{
  RegisterBuiltins();
  CatchInterrupts();
  if (options.file.empty())
    throw UsageError("export: name a format and its file, as --csv table.csv; - is standard output");
  RecordedRun run(std::filesystem::absolute(options.run).lexically_normal().string());
  const CSwarmanoidSpace& space = run.Space();
  const std::vector<ExportColumn> columns = ColumnsOf(space, options.columns);
  std::vector<std::size_t> entities;
  for (std::size_t k = 0; k < space.Size(); ++k)
    if (fnmatch(options.entities.c_str(), space.GetEntity(k).GetId().c_str(), FNM_NOESCAPE) == 0) entities.push_back(k);
  if (entities.empty())
    throw UsageError(fmt::format("--entities: no entity of the run matches {}", Quoted(options.entities)));

  ExportTable table(options.file);
  std::string text = "tick,time_s,entity,kind";
  for (const ExportColumn& column : columns) text += "," + column.name;
  text += "\n";
  std::uint64_t states = 0;
  while (!Interrupted() && run.Next())
  {
    const std::uint64_t tick = space.GetTick();
    if (options.until && tick > *options.until) break;
    if (tick < options.from || tick % options.every != 0) continue;
    ++states;
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
    text.clear();
  }
  table.Write(text);
  table.Close();
  if (Interrupted()) return kExitInterrupted;
  if (states == 0)
    throw UsageError("no tick of the journal is among those that were asked for: see --from, --until, --every");
  return kExitDone;
}

}  // namespace

void AddExportCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ExportOptions>();
  options->columns = {"x", "y", "z", "alpha", "beta", "gamma"};
  CLI::App* verb = app.add_subcommand("export", "Write what the journal of a run has as a table for other tools");
  verb->add_option("RUN", options->run, "The folder of a run as a cluster")->required();
  verb->add_option("--csv", options->file, "Comma-separated values, into a new file; - is standard output");
  verb->add_option(
          "--columns", options->columns,
          "x, y, z (m), alpha, beta, gamma (degrees), qx, qy, qz, qw, attributes as led, or elements as led[3]")
      ->delimiter(',');
  verb->add_option("--entities", options->entities,
                   "Only entities whose ids match: * stands for any characters, ? for one");
  verb->add_option("--every", options->every, "Only ticks that are multiples of this")->check(CLI::Range(1.0, 1e15));
  verb->add_option("--from", options->from, "The first tick");
  verb->add_option("--until", options->until, "The last tick");
  verb->footer(
      "A line for each tick and entity that is in the arena. Numbers are exact: they read back as the same bits.\n"
      "Examples:\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv poses.csv\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv leds.csv --columns x,y,led --entities 'fb_*' "
      "--every 10\n"
      "  swarmanoid export runs/diffusion_10-20310517-093000 --csv - --from 100 --until 100");
  verb->callback([options, &exit_code] { exit_code = Export(*options); });
}

}  // namespace swarmanoid
