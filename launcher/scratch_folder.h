// A folder for what only one command needs; it goes when the object goes.
#pragma once

#include <string>

namespace swarmanoid
{

class ScratchFolder
{
public:
  // Throws std::runtime_error.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& Path() const { return path_; }

private:
  std::string path_;
};

}  // namespace swarmanoid
