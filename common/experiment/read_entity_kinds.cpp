#include <fmt/format.h>

#include <algorithm>

#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/plugins/library.h"

namespace swarmanoid
{
namespace
{

// The library of a kind, loaded; what is wrong with it is reported.
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
    if (library.empty()) continue;
    LoadKind(child, library, reading);
    kinds.push_back({child.Name(), library});
  }
}

}  // namespace swarmanoid
