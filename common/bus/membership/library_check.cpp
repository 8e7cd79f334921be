#include "common/bus/membership/library_check.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "common/plugins/plugin_library.h"
#include "common/run/access/digest.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

bool LiesIn(const fs::path& file, const std::vector<std::string>& folders)
{
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder)
                     {
                       std::error_code none;
                       const fs::path parent = file.parent_path();
                       const fs::path real = fs::canonical(folder, none);
                       return !real.empty() && (parent == real || parent == real / ".libs");
                     });
}

}  // namespace

void AllowOnly(const std::vector<WorldLibrary>& libraries, bool own_folders_only)
{
  SetLibraryCheck(
      [libraries, own_folders_only](const std::string& path) -> std::string
      {
        const std::string digest = DigestOfFile(path);
        const std::string name = fs::path(path).filename().string();
        const auto is_named = [&](const WorldLibrary& library) { return library.name == name; };
        const auto is_meant = [&](const WorldLibrary& library)
        { return is_named(library) && library.digest == digest; };
        if (std::none_of(libraries.begin(), libraries.end(), is_named))
          return "the space server has no such library, so it cannot be known to be the right one; put it on the "
                 "space server's machine, too";
        if (digest.empty() || std::none_of(libraries.begin(), libraries.end(), is_meant))
          return "it is another file than that of the space server (SHA-256); copy that one";
        if (own_folders_only && !LiesIn(path, StandardPluginFolders()))
          return fmt::format(
              "this process takes part by --key, and loads only from the folders that it was started with; name {} in "
              "SWARMANOID_PLUGIN_PATH",
              fs::path(path).parent_path().string());
        return {};
      });
}

}  // namespace swarmanoid
