#include "common/checkpoint/library_builds.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "common/configuration/regular_file.h"
#include "common/experiment/urdf_kind.h"
#include "common/plugins/elf_file.h"
#include "common/plugins/own_library.h"
#include "common/plugins/plugin_library.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// Those of Swarmanoid's libraries whose code the saved state depends on.
constexpr std::array kOwnLibraries{"reproducible_math", "common",
                                   "mesh_files",        "plugin_descriptions",
                                   "control_interface", "behavior_toolkit",
                                   "experiment",        "space",
                                   "physics_engine",    "engines",
                                   "rigid_bodies",      "controller_host_role",
                                   "space_server_role", "argos3"};

std::string BuildOfFile(const std::string& path)
{
  try
  {
    return path.empty() ? std::string() : BuildOfLibrary(path);
  }
  catch (const FileError&)
  {
    return {};
  }
}

// Returns the hash of the content of a file.
std::string HashOfFile(const std::string& path)
{
  constexpr std::size_t kChunk = std::size_t{1} << 20U;
  try
  {
    const RegularFile file(path);
    XXH3_state_t state;
    XXH3_128bits_reset(&state);
    for (std::uint64_t at = 0; at < file.Size(); at += kChunk)
    {
      const std::vector<char> bytes = file.Read(at, kChunk);
      XXH3_128bits_update(&state, bytes.data(), bytes.size());
    }
    const XXH128_hash_t hash = XXH3_128bits_digest(&state);
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  }
  catch (const FileError&)
  {
    return {};
  }
}

// Calls `take` with the files that entities and controllers read, as the experiment names them.
template <class Take>
void ForEachDataFile(const Experiment& experiment, Take take)
{
  for (const EntityKindConfiguration& kind : experiment.entity_kinds)
    if (const UrdfKind* urdf = FindUrdfKind(kind.tag); kind.library.empty() && urdf != nullptr)
    {
      take(fs::path(urdf->file).lexically_relative(experiment.folder).string());
      for (const std::string& mesh : urdf->collision_meshes)
        take(fs::path(mesh).lexically_relative(experiment.folder).string());
    }
  for (const EntityConfiguration& entity : experiment.entities)
  {
    const EntityRole role = DescriptionOf(entity.kind).role;
    if (entity.tree.GetBoolean("convex", false)) take(entity.tree.GetText("mesh", ""));
    if (role == EntityRole::kPatch) take(entity.tree.GetText("picture", ""));
    if (role != EntityRole::kTerrain) continue;
    for (const char* source : {"octomap", "heightmap"})
      if (const TConfigurationTree map = entity.tree.Child(source); map.Exists()) take(map.GetText("file", ""));
  }
  for (const ControllerConfiguration& controller : experiment.controllers)
    for (const TConfigurationTree& part : controller.parameters.Children()) take(part.Value("script").value_or(""));
}

std::string ReadOwnBuild()
{
  std::string builds;
  for (const char* name : kOwnLibraries) builds += BuildOfFile(OwnLibraryFile(name)).substr(0, 16) + ".";
  return builds;
}

}  // namespace

const std::string& OwnBuild()
{
  // The libraries that this process has loaded do not change.
  static const std::string build = ReadOwnBuild();
  return build;
}

void ForEachLibrary(const Experiment& experiment,
                    const std::function<void(const std::string& name, const std::string& file, bool computes)>& take)
{
  const auto add = [&](const std::string& library, const std::vector<std::string>& folders, bool computes = true)
  {
    if (library.empty()) return;
    const std::string file = FindPluginLibrary(library, folders);
    take(fs::path(file.empty() ? library : file).filename().string(), file, computes);
  };
  const auto add_plugin = [&](const TConfigurationTree& tree, bool computes = true)
  { add(tree.Value("library").value_or(""), experiment.plugin_path, computes); };
  for (const EntityKindConfiguration& kind : experiment.entity_kinds) add(kind.library, experiment.plugin_path);
  for (const ControllerConfiguration& controller : experiment.controllers)
  {
    add(controller.library, experiment.controller_path);
    // The libraries that a controller loads itself are named in an element of its parameters.
    for (const TConfigurationTree& part : controller.parameters.Children())
      add(part.Value("library").value_or(""), experiment.controller_path);
    for (const DeviceConfiguration& device : controller.actuators) add_plugin(device.tree);
    for (const DeviceConfiguration& device : controller.sensors) add_plugin(device.tree);
  }
  for (const EngineConfiguration& engine : experiment.engines) add_plugin(engine.tree);
  for (const FunctionsConfiguration& functions : experiment.functions) add_plugin(functions.tree);
  for (const RenderConfiguration& render : experiment.visualisations) add_plugin(render.tree, false);
}

std::vector<LibraryBuild> LibraryBuildsOf(const Experiment& experiment)
{
  std::map<std::string, std::string> builds{{kSwarmanoidBuild, OwnBuild()}};
  ForEachLibrary(experiment,
                 [&](const std::string& name, const std::string& file, bool computes)
                 {
                   if (computes) builds[name] = BuildOfFile(file);
                 });
  ForEachDataFile(experiment,
                  [&](const std::string& name)
                  {
                    if (!name.empty()) builds[name] = HashOfFile(fs::path(experiment.folder) / name);
                  });
  std::vector<LibraryBuild> all;
  for (const auto& [name, build] : builds) all.push_back({name, build});
  return all;
}

std::string NameInText(const LibraryBuild& build)
{
  if (build.name == kSwarmanoidBuild) return build.name;
  return fmt::format("the {} '{}'", build.name.find(".so") == std::string::npos ? "file" : "library", build.name);
}

std::string DifferenceOfBuilds(const std::vector<LibraryBuild>& saved, const std::vector<LibraryBuild>& here)
{
  for (const LibraryBuild& then : saved)
  {
    const auto now =
        std::find_if(here.begin(), here.end(), [&](const LibraryBuild& one) { return one.name == then.name; });
    if (now == here.end() || then.build.empty() || now->build.empty() || now->build == then.build) continue;
    const std::string name = NameInText(then);
    return (name.starts_with("the file") ? "another content of " : "another build of ") + name;
  }
  return {};
}

}  // namespace swarmanoid
