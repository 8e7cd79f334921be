#include "simulation/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/activity/print_error.h"
#include "common/configuration/wording.h"
#include "common/space/terrain/floor_picture.h"
#include "common/space/terrain/terrain.h"
#include "simulation/register_all.h"

namespace swarmanoid
{
namespace
{

// For a file that is not there: the one beside it that may be meant.
std::string NearFile(const std::string& file)
{
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path path(file);
  if (fs::exists(path, none)) return {};
  std::vector<std::string> names;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".xml") names.push_back((path.parent_path() / entry.path().filename()).string());
  std::sort(names.begin(), names.end());
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

std::unique_ptr<Experiment> LoadOrComplain(const std::string& file, const LoadOptions& options)
{
  RegisterBuiltins();
  LoadedExperiment loaded = LoadExperimentFile(file, options);
  for (const Diagnostic& error : loaded.errors) PrintError("{}{}\n", error.Text(), NearFile(file));
  if (!loaded.experiment)
    PrintError("{}: {}\n", file,
               loaded.errors.size() == 1 ? "1 error" : fmt::format("{} errors", loaded.errors.size()));
  if (loaded.experiment && !FilesAreGood(*loaded.experiment)) return nullptr;
  return std::move(loaded.experiment);
}

}  // namespace swarmanoid
