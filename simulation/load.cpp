#include "simulation/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/configuration/wording.h"
#include "common/errors/print_error.h"
#include "common/program/shell_word.h"
#include "common/space/terrain/floor_picture.h"
#include "common/space/terrain/terrain.h"
#include "simulation/register_all.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

std::vector<std::string> ExperimentsIn(const fs::path& folder)
{
  std::error_code none;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".xml") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// A folder is no experiment. Its content tells what the user wants instead.
std::string AdviceAboutFolder(const fs::path& folder)
{
  std::error_code none;
  const std::string name = folder.string();
  if (fs::exists(folder / "manifest.json", none))
    return fmt::format(
        "the folder of a run. See the run: swarmanoid replay {0}; go on with it: swarmanoid resume {0}; "
        "run it again: swarmanoid run {1}",
        ShellWord(name), ShellWord(folder / "experiment.xml"));
  if (fs::exists(folder / "study.sqlite", none))
    return fmt::format("the folder of a study. Go on with it: swarmanoid sweep {} --resume", ShellWord(name));
  const std::vector<std::string> files = ExperimentsIn(folder);
  if (files.empty()) return "a folder without experiment files. Make one: swarmanoid new experiment NAME";
  return fmt::format("a folder. Name an experiment file in it, such as {}", (folder / files.front()).string());
}

// The file beside a missing one that may be meant.
std::string NearFile(const std::string& file)
{
  std::error_code none;
  const fs::path path(file);
  if (fs::exists(path, none)) return {};
  std::vector<std::string> names;
  for (const std::string& name : ExperimentsIn(path.has_parent_path() ? path.parent_path() : fs::path(".")))
    names.push_back((path.parent_path() / name).string());
  return DidYouMean(file, names);
}

}  // namespace

bool FilesAreGood(const Experiment& experiment)
{
  bool good = true;
  for (const EntityConfiguration& entity : experiment.entities)
  {
    const EntityRole role = DescriptionOf(entity.kind).role;
    try
    {
      if (role == EntityRole::kTerrain) LoadTerrain(entity, experiment.folder);
      if (role == EntityRole::kPatch) LoadFloorPicture(entity, experiment.folder);
    }
    catch (const ConfigurationError& error)
    {
      good = false;
      PrintError("{}\n", error.what());
    }
  }
  return good;
}

std::unique_ptr<Experiment> LoadOrComplain(const std::string& file, const LoadOptions& options, std::string* places)
{
  RegisterBuiltins();
  std::error_code none;
  if (fs::is_directory(file, none))
  {
    PrintError("{}: this is {}\n", file, AdviceAboutFolder(file));
    return nullptr;
  }
  LoadedExperiment loaded = LoadExperimentFile(file, options);
  for (const Diagnostic& error : loaded.errors) PrintError("{}{}\n", error.Text(), NearFile(file));
  if (!loaded.experiment)
    PrintError("{}: {}\n", file,
               loaded.errors.size() == 1 ? "1 error" : fmt::format("{} errors", loaded.errors.size()));
  if (loaded.experiment && !FilesAreGood(*loaded.experiment)) return nullptr;
  if (places != nullptr) *places = std::move(loaded.places);
  return std::move(loaded.experiment);
}

}  // namespace swarmanoid
