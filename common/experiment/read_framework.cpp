#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kLongestId = 64;

}  // namespace

bool IsIdCharacter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == ':' || c == '-';
}

bool CheckId(const std::string& id, const SourceLocation& place, Diagnostics& diagnostics)
{
  const bool good = !id.empty() && id.size() <= kLongestId && std::all_of(id.begin(), id.end(), IsIdCharacter) &&
                    id.front() != '.' && id.front() != ':' && id.front() != '-';
  if (!good)
  {
    diagnostics.Add(place,
                    fmt::format("the id {} must be 1 to {} letters, digits, '_', '.', ':' or '-', and start with none "
                                "of the last three",
                                Quoted(id), kLongestId));
  }
  return good;
}

const PluginDescription* FindPlugin(PluginKind kind, const TConfigurationTree& tree, Reading& reading)
{
  const bool device = kind == PluginKind::kActuator || kind == PluginKind::kSensor;
  const std::string library = tree.Value("library").value_or("");
  if (!library.empty())
  {
    const PluginLibrary& loaded = LoadPluginLibrary(library, reading.experiment.plugin_path);
    if (!loaded.error.empty())
    {
      reading.diagnostics.Add(tree.ValueLocation("library"), loaded.error);
      return nullptr;
    }
  }

  const PluginCatalogue& catalogue = PluginCatalogue::Instance();
  const std::string_view what = PluginKindName(kind);
  const std::vector<std::string> labels = catalogue.Labels(kind);
  const std::string implementation = device ? tree.Value("implementation").value_or("") : std::string();
  if (const PluginDescription* found = catalogue.Find(kind, tree.Name(), implementation)) return found;

  const std::vector<std::string> implementations = catalogue.Implementations(kind, tree.Name());
  if (implementations.empty())
  {
    reading.diagnostics.Add(tree.Location(), fmt::format("there is no {} <{}>; known: {}{}", what, tree.Name(),
                                                         Listed(labels), DidYouMean(tree.Name(), labels)));
  }
  else if (device && !implementation.empty())
  {
    reading.diagnostics.Add(
        tree.ValueLocation("implementation"),
        fmt::format("the {} <{}> has no implementation {}; known: {}{}", what, tree.Name(), Quoted(implementation),
                    Listed(implementations), DidYouMean(implementation, implementations)));
  }
  else
  {
    reading.diagnostics.Add(
        tree.Location(), fmt::format("<{}> lacks its implementation; known: {}", tree.Name(), Listed(implementations)));
  }
  return nullptr;
}

void ReadFramework(const TConfigurationTree& tree, Reading& reading)
{
  Experiment& experiment = reading.experiment;
  const ElementReader reader(tree, ExperimentSchema().Child("framework"), reading.diagnostics);
  experiment.clock_tick_ms = static_cast<std::uint32_t>(reader.Integer("clocktick"));
  experiment.ticks_per_second = static_cast<std::uint32_t>(reader.Integer("ticks_per_second"));
  if (experiment.ticks_per_second != 0 && tree.Value("clocktick"))
    reading.diagnostics.Add(tree.ValueLocation("ticks_per_second"),
                            "'clocktick' is given, too; leave 'clocktick' or 'ticks_per_second' out");
  experiment.max_clock = static_cast<std::uint64_t>(reader.Integer("maxclock"));
  experiment.seed = static_cast<std::uint64_t>(reader.Integer("seed"));
  experiment.canonical_period = static_cast<std::uint32_t>(reader.Integer("canonical_period"));
  experiment.ahead = static_cast<std::uint32_t>(reader.Integer("ahead"));

  const std::string name = reader.Text("name");
  if (!name.empty() && CheckId(name, reader.Place("name"), reading.diagnostics)) experiment.name = name;
  const std::string folder = reader.Text("folder");
  if (!folder.empty()) experiment.folder = (fs::path(experiment.folder) / folder).lexically_normal().string();

  const auto paths = [&](const char* parameter)
  {
    std::vector<std::string> folders = SplitSearchPath(reader.Text(parameter), experiment.folder);
    folders.push_back(experiment.folder);
    for (std::string& standard : StandardPluginFolders()) folders.push_back(std::move(standard));
    return folders;
  };
  experiment.controller_path = paths("controller_path");
  experiment.plugin_path = paths("plugin_path");
}

}  // namespace swarmanoid
