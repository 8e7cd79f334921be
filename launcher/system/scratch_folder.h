// ScratchFolder: a folder for temporary files of one command. It is removed with the object.
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
