#include "launcher/installation.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kServer = "space_server";

fs::path OwnFolder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

// Beside this program, or, if that is a user's own, in the package that this library belongs to.
fs::path FolderOfPrograms()
{
  const fs::path own = OwnFolder();
  std::error_code none;
  if (fs::exists(own / kServer, none)) return own;
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&FolderOfPrograms), &library) == 0) return own;
  const fs::path file = fs::canonical(library.dli_fname, none);
  for (fs::path folder = file.parent_path(); folder != folder.parent_path(); folder = folder.parent_path())
    if (fs::exists(folder / "bin" / kServer, none)) return folder / "bin";
  return own;
}

}  // namespace

std::string ProgramFolder()
{
  if (const char* folder = std::getenv("SWARMANOID_PROGRAM_DIR")) return fs::absolute(folder);
  return FolderOfPrograms();
}

std::string UserFilesFolder() { return OwnFolder().parent_path() / "share" / "swarmanoid" / "user"; }

}  // namespace swarmanoid
