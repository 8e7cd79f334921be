#include "launcher/system/installation.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

fs::path OwnFolder() { return fs::path(OwnProgram()).parent_path(); }

fs::path SampleFolder() { return OwnFolder().parent_path() / "share" / "swarmanoid" / "configs"; }

// Returns the folder of programs of an installation or a build folder, or an empty path if it has none.
fs::path ProgramsUnder(const fs::path& prefix)
{
  std::error_code none;
  for (const char* folder : {"libexec/swarmanoid", "bin"})
    if (fs::exists(prefix / folder / "space_server", none)) return prefix / folder;
  return {};
}

// Returns the programs of the package that this program belongs to. For a user's own program, it is the package of this
// library.
fs::path FolderOfPrograms()
{
  const fs::path own = OwnFolder();
  if (const fs::path found = ProgramsUnder(own.parent_path()); !found.empty()) return found;
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&FolderOfPrograms), &library) == 0) return own;
  std::error_code none;
  const fs::path file = fs::canonical(library.dli_fname, none);
  for (fs::path folder = file.parent_path(); folder != folder.parent_path(); folder = folder.parent_path())
    if (const fs::path found = ProgramsUnder(folder); !found.empty()) return found;
  return own;
}

}  // namespace

std::string OwnProgram() { return fs::read_symlink("/proc/self/exe"); }

std::string ProgramFolder()
{
  if (const char* folder = std::getenv("SWARMANOID_PROGRAM_DIR")) return fs::absolute(folder);
  return FolderOfPrograms();
}

std::vector<std::string> SampleNames()
{
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(SampleFolder(), none))
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem());
  std::ranges::sort(names);
  return names;
}

std::string SampleFile(const std::string& name) { return SampleFolder() / (name + ".xml"); }

std::string UserFilesFolder() { return OwnFolder().parent_path() / "share" / "swarmanoid" / "user"; }

}  // namespace swarmanoid
