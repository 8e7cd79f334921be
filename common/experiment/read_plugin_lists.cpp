#include "common/configuration/parameter_table.h"
#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/experiment/unique_ids.h"

namespace swarmanoid
{
namespace
{

// Reads the plug-ins of a section that lists them. Each has an id that is unique in the section.
template <class Add>
void ReadPluginList(const TConfigurationTree& tree, PluginKind kind, Reading& reading, Add add)
{
  if (!tree.Exists()) return;
  const ElementSpec& spec = ExperimentSchema().Child(tree.Name());
  const ElementReader list(tree, spec, reading.diagnostics);
  UniqueIds ids(tree.Name());
  for (const TConfigurationTree& child : tree.Children())
  {
    const PluginDescription* plugin = FindPlugin(kind, child, reading);
    const ElementReader reader(child, spec.plugin_element.front(), reading.diagnostics,
                               plugin != nullptr ? &plugin->parameters : nullptr, plugin == nullptr);
    const std::string id = reader.Text("id");
    if (reader.IsGiven("id")) CheckId(id, reader.Place("id"), reading.diagnostics);
    if (const std::string mistake = ids.Add(id, child.Location().line); !mistake.empty())
      reading.diagnostics.Add(reader.Place("id"), mistake);
    add(child, id);
  }
}

}  // namespace

void ReadVisualisations(const TConfigurationTree& tree, Reading& reading)
{
  ReadPluginList(tree, PluginKind::kRenderer, reading,
                 [&](const TConfigurationTree& child, const std::string& id) {
                   reading.experiment.visualisations.push_back({child.Name(), id, child, child.Location()});
                 });
}

void ReadExperimentFunctions(const TConfigurationTree& tree, Reading& reading)
{
  ReadPluginList(tree, PluginKind::kExperimentFunctions, reading,
                 [&](const TConfigurationTree& child, const std::string& id)
                 {
                   const auto* plugin =
                       PluginCatalogue::Instance().Find(PluginKind::kExperimentFunctions, child.Name());
                   const TConfigurationTree filled =
                       plugin == nullptr ? child : WithDefaults(child, plugin->parameters, reading.experiment.folder);
                   reading.experiment.functions.push_back({child.Name(), id, filled, child.Location()});
                 });
}

}  // namespace swarmanoid
