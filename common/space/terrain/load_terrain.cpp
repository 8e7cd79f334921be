#include <filesystem>
#include <map>
#include <mutex>

#include "common/space/terrain/terrain.h"

namespace swarmanoid
{
namespace
{

std::shared_ptr<const Terrain> Read(const TConfigurationTree& source, const std::string& path)
{
  if (source.Name() == "octomap") return std::make_shared<VoxelTerrain>(path);
  const auto size = ParseNumbers(source.GetText("size"));
  if (!size || size->size() != 2 || !((*size)[0] > 0 && (*size)[1] > 0))
    throw std::runtime_error("<heightmap size> must be two positive lengths in metres, as in size=\"20, 20\"");
  return std::make_shared<HeightTerrain>(path, (*size)[0], (*size)[1], source.GetNumber("height"));
}

}  // namespace

std::shared_ptr<const Terrain> LoadTerrain(const EntityConfiguration& configuration,
                                           const std::string& experiment_folder)
{
  TConfigurationTree source = configuration.tree.Child("octomap");
  if (!source.Exists()) source = configuration.tree.Child("heightmap");
  if (!source.Exists())
    throw ConfigurationError(configuration.location,
                             "terrain '" + configuration.id +
                                 "' needs <octomap file=\"…\"/> or <heightmap file=\"…\" size=\"…\" height=\"…\"/>");
  const std::string path =
      (std::filesystem::path(experiment_folder) / source.GetText("file")).lexically_normal().string();

  // Maps are large and read-only, so a process keeps one copy for all entities and roles.
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Terrain>> loaded;
  const std::string key =
      source.Name() + '|' + path + '|' + source.GetText("size", "") + '|' + source.GetText("height", "");
  const std::lock_guard lock(mutex);
  if (auto terrain = loaded[key].lock()) return terrain;
  try
  {
    auto terrain = Read(source, path);
    loaded[key] = terrain;
    return terrain;
  }
  catch (const ConfigurationError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw ConfigurationError(source.Location(), "terrain '" + configuration.id + "': " + error.what());
  }
}

}  // namespace swarmanoid
