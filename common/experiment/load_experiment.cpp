// Loading has these stages: parse the XML, convert the file of another simulator, apply --set and --seed to the tree,
// and read the sections in their order. All readers add mistakes to one list, so that a user sees all of them. The tree
// with all changes is written as the effective text for the other processes.
#include "common/experiment/load_experiment.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/foreign_experiments.h"
#include "common/experiment/sections.h"
#include "common/experiment/settings.h"
#include "common/experiment/source_places.h"
#include "common/program/shell_word.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using Node = std::shared_ptr<const ConfigurationNode>;

LoadedExperiment Refused(std::vector<Diagnostic> errors)
{
  LoadedExperiment loaded;
  loaded.errors = std::move(errors);
  return loaded;
}

LoadedExperiment Refused(const ConfigurationError& error)
{
  return Refused(std::vector<Diagnostic>{{error.Location(), error.Message()}});
}

// The name is used in folders and topics, so only characters of ids are kept.
std::string NameOfFile(const std::string& file_name)
{
  std::string name = fs::path(file_name).stem().string().substr(0, 64);
  for (char& c : name)
  {
    if (!IsIdCharacter(c)) c = '_';
  }
  if (name.empty()) return "experiment";
  if (name.front() == '.' || name.front() == '-' || name.front() == ':') name.front() = '_';
  return name;
}

Node WithSettings(Node root, const LoadOptions& options, Diagnostics& diagnostics)
{
  std::map<std::string, std::string> paths;  // by the address of the changed value
  for (const auto& [path, value] : options.settings)
  {
    try
    {
      CheckSettingValue(path, value);
      const auto [first, is_new] = paths.try_emplace(SettingAddress(root, path), path);
      root = WithSetting(root, path, value);
      if (!is_new)
        diagnostics.Add(
            {std::make_shared<const std::string>("--set " + path), 0, 0},
            fmt::format("{} is set already, by --set {}; leave one of the two out", Quoted(path), first->second));
    }
    catch (const ConfigurationError& error)
    {
      diagnostics.Add(error.Location(), error.Message());
    }
  }
  return root;
}

void ReadSections(const TConfigurationTree& root, Reading& reading)
{
  const ElementReader reader(root, ExperimentSchema(), reading.diagnostics);
  ReadFramework(root.Child("framework"), reading);
  if (reading.options.engines_alone) return ReadEngines(root.Child("engines"), reading);
  ReadEntityKinds(root.Child("entity_kinds"), reading);
  ReadControllers(root.Child("controllers"), reading);
  ReadArena(root.Child("arena"), reading);
  ReadEngines(root.Child("engines"), reading);
  ReadArenaPhysics(root.Child("arena_physics"), reading);
  reading.experiment.engine_choices = FindEngineChoices(reading.experiment);
  PlaceDistributed(reading);
  ReadVisualisations(root.Child("visualisations"), reading);
  ReadExperimentFunctions(root.Child("experiment_functions"), reading);
  ReadFaults(root.Child("faults"), reading);
  CheckControllersOfRobots(reading);
  CheckFloorFieldDevices(reading);
  CheckDevicesOfEngines(reading);
  CheckPlanes(reading);
  CheckVolumes(reading);
  CheckOverlaps(reading);
}

std::string FolderOfFile(const std::string& path)
{
  return fs::absolute(fs::path(path)).parent_path().lexically_normal().string();
}

// Returns the root element. The root of another simulator's file is converted.
Node ReadRoot(const std::string& text, const std::string& file_name, const std::string& folder,
              const ExperimentSettings& settings, std::vector<Diagnostic>& mistakes)
{
  Node root = ReadExperimentXml(text, file_name);
  if (const ExperimentConverter* convert = FindExperimentConverter(root->name))
    return (*convert)(*root, folder, settings, mistakes);
  return root;
}

}  // namespace

LoadedExperiment LoadExperimentText(const std::string& text, const std::string& file_name, const std::string& folder,
                                    const LoadOptions& options)
{
  Diagnostics diagnostics;
  try
  {
    std::vector<Diagnostic> mistakes;
    const Node file_root = ReadRoot(text, file_name, folder, options.settings, mistakes);
    if (!mistakes.empty()) return Refused(std::move(mistakes));
    if (file_root->name != ExperimentSchema().Name())
    {
      std::string advice;
      if (file_root->name == "study") advice = "; a study is run by: swarmanoid sweep " + ShellWord(file_name);
      if (file_root->name == "sdf") advice = "; a world is converted by: swarmanoid convert " + ShellWord(file_name);
      return Refused(std::vector<Diagnostic>{
          {file_root->location, fmt::format("the root element is <{}>; it must be <{}>{}", file_root->name,
                                            ExperimentSchema().Name(), advice)}});
    }
    const Node root = WithSettings(file_root, options, diagnostics);
    auto experiment = std::make_unique<Experiment>();
    experiment->name = NameOfFile(file_name);
    experiment->folder = folder;
    Reading reading{*experiment, diagnostics, options};
    ReadSections(TConfigurationTree(root), reading);
    if (!diagnostics.Empty())
    {
      LoadedExperiment wrong = Refused(diagnostics.Take(file_name));
      if (options.even_if_wrong) wrong.experiment = std::move(experiment);
      return wrong;
    }

    // Other processes that read the text find the same name and folder.
    const Node named =
        WithSetting(WithSetting(root, "framework.name", experiment->name), "framework.folder", experiment->folder);
    experiment->effective_xml = WriteXml(*named);
    return {std::move(experiment), {}, WritePlaces(*named)};
  }
  catch (const ConfigurationError& error)
  {
    return Refused(error);
  }
}

LoadedExperiment LoadExperimentFile(const std::string& path, const LoadOptions& options)
{
  try
  {
    return LoadExperimentText(ReadTextFile(path), path, FolderOfFile(path), options);
  }
  catch (const ConfigurationError& error)
  {
    return Refused(error);
  }
}

Node ReadExperimentTree(const std::string& path)
{
  try
  {
    std::vector<Diagnostic> mistakes;
    Node root = ReadRoot(ReadTextFile(path), path, FolderOfFile(path), {}, mistakes);
    return mistakes.empty() ? root : nullptr;
  }
  catch (const ConfigurationError&)
  {
    return nullptr;
  }
}

}  // namespace swarmanoid
