#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/experiment/urdf_kind.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid
{
namespace
{

// Loads the library of a kind and reports its mistakes.
void LoadKind(const TConfigurationTree& tree, const std::string& name, Reading& reading)
{
  const PluginLibrary& library = LoadPluginLibrary(name, reading.experiment.plugin_path);
  if (!library.error.empty()) return reading.diagnostics.Add(tree.ValueLocation("library"), library.error);
  std::vector<std::string> tags;
  for (const auto& [kind, label] : library.registrations.labels)
    if (kind == PluginKind::kEntityKind) tags.push_back(label);
  if (std::find(tags.begin(), tags.end(), tree.Name()) != tags.end()) return;
  reading.diagnostics.Add(tree.Location(),
                          fmt::format("the library {} registers no entity kind <{}>; it registers: {}{}", library.path,
                                      tree.Name(), Listed(tags), DidYouMean(tree.Name(), tags)));
}

// Registers the kind of a URDF file and reports its mistakes with their positions in it.
void LoadUrdf(const TConfigurationTree& tree, const std::string& file, Reading& reading)
{
  const std::string path = (std::filesystem::path(reading.experiment.folder) / file).lexically_normal().string();
  try
  {
    for (const Diagnostic& mistake : RegisterUrdfKind(tree.Name(), path))
      reading.diagnostics.Add(mistake.location, mistake.message);
  }
  catch (const ConfigurationError& error)
  {
    reading.diagnostics.Add(tree.ValueLocation("urdf"), fmt::format("{}: {}", path, error.Message()));
  }
}

}  // namespace

void ReadEntityKinds(const TConfigurationTree& tree, Reading& reading)
{
  if (!tree.Exists()) return;
  const ElementSpec& spec = ExperimentSchema().Child("entity_kinds");
  const ElementReader list(tree, spec, reading.diagnostics);
  for (const TConfigurationTree& child : tree.Children())
  {
    const ElementReader reader(child, spec.plugin_element.front(), reading.diagnostics);
    const std::string library = reader.Text("library");
    auto& kinds = reading.experiment.entity_kinds;
    const auto same = [&](const EntityKindConfiguration& other) { return other.tag == child.Name(); };
    if (std::any_of(kinds.begin(), kinds.end(), same))
      reading.diagnostics.Add(child.Location(), fmt::format("<{}> is listed twice", child.Name()));
    const std::string urdf = reader.Text("urdf");
    const std::size_t mistakes = reading.diagnostics.Count();
    if (library.empty() == urdf.empty())
    {
      reading.diagnostics.Add(child.Location(), fmt::format("<{0}> needs one of library and urdf: the library that "
                                                            "registers it, or its URDF file",
                                                            child.Name()));
      reading.diagnostics.Lose(child.Name());
      continue;
    }
    if (urdf.empty())
      LoadKind(child, library, reading);
    else
      LoadUrdf(child, urdf, reading);
    if (reading.diagnostics.Count() > mistakes) reading.diagnostics.Lose(child.Name());
    kinds.push_back({child.Name(), library});
  }
}

}  // namespace swarmanoid
