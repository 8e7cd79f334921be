#include "common/experiment/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "common/configuration/regular_file.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kMeshEndings{".glb", ".gltf", ".obj", ".stl"};
constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

std::string WhenThere(const fs::path& path)
{
  return FileMistake(path.string()).empty() ? path.lexically_normal().string() : std::string();
}

}  // namespace

std::string MeshFileMistake(const std::string& path)
{
  std::string ending = fs::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::ranges::find(kMeshEndings, ending) == kMeshEndings.end())
    return fmt::format("meshes are read from files that end in {}; export it as .glb, for example with Blender",
                       fmt::join(kMeshEndings, ", "));
  return FileMistake(path);
}

std::string FindUrdfMesh(const std::string& name, const std::string& urdf_file)
{
  const fs::path folder = fs::absolute(urdf_file).parent_path();
  if (name.starts_with(kFile)) return WhenThere(name.substr(kFile.size()));
  if (!name.starts_with(kPackage)) return WhenThere(folder / name);
  const fs::path inside = name.substr(kPackage.size());
  for (fs::path above = folder;; above = above.parent_path())
  {
    if (std::string found = WhenThere(above / inside); !found.empty()) return found;
    if (above == above.parent_path()) return {};
  }
}

std::string FindMeshOfKind(const std::string& name, const Experiment& experiment)
{
  const fs::path usual = fs::path(experiment.folder) / name;
  if (!WhenThere(usual).empty()) return usual.lexically_normal().string();
  for (const std::string& folder : experiment.plugin_path)
    if (std::string found = WhenThere(fs::path(folder) / name); !found.empty()) return found;
  return usual.lexically_normal().string();
}

std::string MeshOfEntity(const EntityConfiguration& entity, const std::string& experiment_folder)
{
  const std::string file = entity.tree.GetText("mesh", "");
  return file.empty() ? file : (fs::path(experiment_folder) / file).lexically_normal().string();
}

}  // namespace swarmanoid
