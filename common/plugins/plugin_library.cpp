#include "common/plugins/plugin_library.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string_view>

#include "common/configuration/wording.h"
#include "common/math/reproducible_math.h"
#include "common/plugins/elf_file.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

std::vector<std::string> FileNames(const std::string& name)
{
  if (name.ends_with(".so")) return {name};
  return {"lib" + name + ".so", name + ".so"};
}

// Returns all paths where a library may be, in the order of the search.
std::vector<std::string> Candidates(std::string_view name, std::span<const std::string> folders)
{
  std::vector<std::string> candidates;
  if (name.find('/') != std::string_view::npos)
  {
    const fs::path path(name);
    const fs::path base = path.is_absolute() || folders.empty() ? fs::path() : fs::path(folders.front());
    for (const std::string& file : FileNames(path.filename().string()))
    {
      candidates.push_back((base / path.parent_path() / file).lexically_normal().string());
    }
    return candidates;
  }
  for (const std::string& folder : folders)
  {
    for (const std::string& file : FileNames(std::string(name)))
    {
      candidates.push_back((fs::path(folder) / file).lexically_normal().string());
      candidates.push_back((fs::path(folder) / ".libs" / file).lexically_normal().string());
    }
  }
  return candidates;
}

// Returns the path without links; empty if the file does not exist.
std::string RealFile(const std::string& path)
{
  std::error_code error;
  // Most files do not exist. This takes one system call, instead of one for each folder on the way.
  if (!fs::is_regular_file(path, error)) return {};
  const fs::path real = fs::canonical(path, error);
  return error ? std::string() : real.string();
}

// Returns the loaded libraries by their real paths. Libraries that could not be loaded are kept too, so that each error
// is found once.
std::map<std::string, PluginLibrary>& LoadedLibraries()
{
  static std::map<std::string, PluginLibrary> libraries;
  return libraries;
}

std::function<std::string(const std::string&)>& LibraryCheck()
{
  static std::function<std::string(const std::string&)> check;
  return check;
}

PluginLibrary Load(const std::string& path)
{
  PluginLibrary library;
  library.path = path;
  if (const std::string why = LibraryCheck() ? LibraryCheck()(path) : std::string(); !why.empty())
  {
    library.error = "the library " + path + " is not loaded: " + why;
    return library;
  }
  // Loading a library that is cut short would end the program by a signal.
  if (const std::string mistake = MistakeInLibrary(path); !mistake.empty())
  {
    library.error = "the library " + path + " cannot be loaded: " + mistake;
    return library;
  }
  PluginCatalogue& catalogue = PluginCatalogue::Instance();
  catalogue.BeginLibrary();
  void* handle = OpenLibrary(path);
  const char* reason = handle == nullptr ? dlerror() : nullptr;
  library.registrations = catalogue.EndLibrary();
  if (handle == nullptr)
  {
    library.error = "the library " + path + " cannot be loaded: " + (reason != nullptr ? reason : "unknown reason");
  }
  for (const std::string& problem : library.registrations.problems)
  {
    library.error += (library.error.empty() ? "the library " + path + ": " : "; ") + problem;
  }
  return library;
}

}  // namespace

void SetLibraryCheck(std::function<std::string(const std::string& path)> check) { LibraryCheck() = std::move(check); }

std::string FindPluginLibrary(std::string_view name, std::span<const std::string> folders)
{
  for (const std::string& candidate : Candidates(name, folders))
    if (const std::string file = RealFile(candidate); !file.empty()) return file;
  return {};
}

const PluginLibrary& LoadPluginLibrary(std::string_view name, std::span<const std::string> folders)
{
  std::string searched;
  std::string before;
  for (const std::string& candidate : Candidates(name, folders))
  {
    const std::string file = RealFile(candidate);
    if (file.empty())
    {
      if (candidate == before) continue;
      searched += "\n    " + candidate;
      std::error_code error;
      if (fs::exists(candidate, error)) searched += " (which is not a file)";
      before = candidate;
      continue;
    }
    auto& libraries = LoadedLibraries();
    const auto found = libraries.find(file);
    return found != libraries.end() ? found->second : libraries.emplace(file, Load(file)).first->second;
  }
  // The entry has a name that no path has, so that the reference stays valid.
  PluginLibrary& missing = LoadedLibraries()["missing " + std::string(name)];
  missing.error = "the library " + Quoted(name) +
                  " is not found; build it, or name its folder in <controller_path> or " +
                  "<plugin_path>; searched:" + (searched.empty() ? " nowhere" : searched);
  return missing;
}

std::vector<std::string> SplitSearchPath(const std::string& list, const std::string& base)
{
  std::string joined;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    const std::size_t next = list[i] == '\\' ? list.find_first_not_of(" \t\r", i + 1) : std::string::npos;
    if (next == std::string::npos || list[next] != '\n')
    {
      joined += list[i];
      continue;
    }
    i = list.find_first_not_of(" \t\r\n", next);
    if (i == std::string::npos) break;
    --i;
  }

  std::vector<std::string> folders;
  for (std::string_view rest = joined; !rest.empty();)
  {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const std::string_view entry = TrimBlanks(rest.substr(0, colon));
    if (!entry.empty()) folders.push_back((fs::path(base) / fs::path(entry)).lexically_normal().string());
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return folders;
}

std::string OwnLibraryFolder()
{
  static const std::string folder = []
  {
    Dl_info place{};
    if (dladdr(reinterpret_cast<const void*>(&StandardPluginFolders), &place) == 0 || place.dli_fname == nullptr)
      return std::string();
    std::error_code error;
    return fs::weakly_canonical(place.dli_fname, error).parent_path().string();
  }();
  return folder;
}

std::vector<std::string> StandardPluginFolders()
{
  std::vector<std::string> folders;
  if (const char* list = std::getenv("SWARMANOID_PLUGIN_PATH"))
    folders = SplitSearchPath(list, fs::current_path().string());
  if (const fs::path own = OwnLibraryFolder(); !own.empty())
  {
    folders.push_back(own.string());
    folders.push_back((own / "swarmanoid").string());
    folders.push_back((own / "swarmanoid" / "controllers").string());
  }
  return folders;
}

}  // namespace swarmanoid
