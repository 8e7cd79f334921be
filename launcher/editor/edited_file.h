// The file of an experiment that is edited: written beside and renamed, so that at every moment the old or the new one
// is there as a whole, and looked at for changes of others. Used by `swarmanoid edit`.
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

namespace swarmanoid
{

class EditedFile
{
public:
  // Links are followed: what they lead to is written. Throws ConfigurationError if it cannot be read.
  explicit EditedFile(const std::string& path);

  const std::string& Path() const { return path_; }  // as it was given
  // What was last read or written.
  const std::string& Text() const { return text_; }
  // Whether the file holds something else now, or is gone. Quick while nobody has touched it.
  bool HasChanged();
  // What it holds now; throws ConfigurationError.
  std::string OnDisk() const;
  // That this is what was read.
  void Accept(const std::string& text);
  // Throws std::runtime_error, with the cure; then the file is what it was.
  void Write(const std::string& text);

private:
  void Look();

  std::string path_;
  std::string target_;  // behind all links
  std::string text_;
  std::optional<struct stat> seen_;
  bool changed_ = false;
};

}  // namespace swarmanoid
