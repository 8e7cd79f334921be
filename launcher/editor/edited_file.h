// EditedFile: the file of an edited experiment. It is written beside the old one and renamed, so that a whole file is
// there at every moment. It also detects changes by other programs. `swarmanoid edit` uses it.
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

namespace swarmanoid
{

class EditedFile
{
public:
  // Opens a file; links are followed, and their target is written. Throws ConfigurationError if it cannot be read.
  explicit EditedFile(const std::string& path);

  const std::string& Path() const { return path_; }  // the path as it was given
  // Returns the text that was last read or written.
  const std::string& Text() const { return text_; }
  // Returns true if the file was removed or has another content. This is fast if the file was not touched.
  bool HasChanged();
  // Returns the present content of the file; throws ConfigurationError.
  std::string OnDisk() const;
  // Records that this text was read.
  void Accept(const std::string& text);
  // Writes the file. Throws std::runtime_error with the cure; the file then has its old content.
  void Write(const std::string& text);

private:
  void Look();

  std::string path_;
  std::string target_;  // the path after all links
  std::string text_;
  std::optional<struct stat> seen_;
  bool changed_ = false;
};

}  // namespace swarmanoid
