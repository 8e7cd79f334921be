#include "launcher/system/scratch_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace swarmanoid
{

ScratchFolder::ScratchFolder() : path_((std::filesystem::temp_directory_path() / "swarmanoid-XXXXXX").string())
{
  if (mkdtemp(path_.data()) == nullptr)
    throw std::runtime_error(fmt::format("cannot make the folder '{}': {}", path_, std::strerror(errno)));
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace swarmanoid
