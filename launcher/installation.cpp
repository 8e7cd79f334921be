#include "launcher/installation.h"

#include <cstdlib>
#include <filesystem>

namespace swarmanoid
{
namespace
{

std::filesystem::path OwnFolder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace

std::string ProgramFolder()
{
  if (const char* folder = std::getenv("SWARMANOID_PROGRAM_DIR")) return std::filesystem::absolute(folder);
  return OwnFolder();
}

std::string UserFilesFolder() { return OwnFolder().parent_path() / "share" / "swarmanoid" / "user"; }

}  // namespace swarmanoid
