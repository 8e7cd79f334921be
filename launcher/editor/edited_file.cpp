#include "launcher/editor/edited_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

bool IsSame(const struct stat& a, const struct stat& b)
{
  return a.st_ino == b.st_ino && a.st_dev == b.st_dev && a.st_size == b.st_size &&
         a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

std::optional<struct stat> StateOf(const std::string& path)
{
  struct stat state
  {
  };
  return stat(path.c_str(), &state) == 0 ? std::optional(state) : std::nullopt;
}

// It makes a temporary file beside the target. The file is removed unless it has replaced the target.
class FileBeside
{
public:
  explicit FileBeside(const std::string& target) : target_(target)
  {
    const fs::path folder = fs::path(target).parent_path();
    name_ = (folder / ("." + fs::path(target).filename().string() + ".XXXXXX")).string();
    file_ = mkostemp(name_.data(), O_CLOEXEC);
    if (file_ < 0) Fail("cannot write beside it");
  }
  ~FileBeside()
  {
    if (file_ >= 0) close(file_);
    if (!placed_ && !name_.empty()) unlink(name_.c_str());
  }
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;

  void Fill(std::string_view text, const struct stat& like)
  {
    // The permissions stay. The owner stays too, if this user may set it.
    if (fchown(file_, like.st_uid, like.st_gid) != 0 && errno != EPERM) Fail("cannot keep its owner");
    if (fchmod(file_, like.st_mode & 07777U) != 0) Fail("cannot keep its permissions");
    while (!text.empty())
    {
      const ssize_t count = write(file_, text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) Fail("cannot write beside it");
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    if (fsync(file_) != 0) Fail("cannot write beside it");
  }

  void TakePlace()
  {
    if (rename(name_.c_str(), target_.c_str()) != 0) Fail("cannot rename what was written beside it");
    placed_ = true;
    const int folder = open(fs::path(target_).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    fsync(folder);
    close(folder);
  }

private:
  [[noreturn]] void Fail(const char* what) const
  {
    throw std::runtime_error(
        fmt::format("'{}' is not saved: {}: {}; your changes are still here", target_, what, std::strerror(errno)));
  }

  std::string target_;
  std::string name_;
  int file_ = -1;
  bool placed_ = false;
};

}  // namespace

EditedFile::EditedFile(const std::string& path) : path_(path)
{
  text_ = ReadTextFile(path);
  target_ = fs::canonical(path).string();
  Look();
}

void EditedFile::Look()
{
  seen_ = StateOf(target_);
  changed_ = false;
}

bool EditedFile::HasChanged()
{
  const auto now = StateOf(target_);
  if (now && seen_ && IsSame(*now, *seen_)) return changed_;
  seen_ = now;
  try
  {
    changed_ = !now || ReadTextFile(target_) != text_;
  }
  catch (const std::runtime_error&)
  {
    changed_ = true;
  }
  return changed_;
}

std::string EditedFile::OnDisk() const { return ReadTextFile(target_); }

void EditedFile::Accept(const std::string& text)
{
  text_ = text;
  seen_.reset();  // the file may have changed since then
  HasChanged();
}

void EditedFile::Write(const std::string& text)
{
  struct stat like
  {
  };
  like.st_uid = geteuid();
  like.st_gid = getegid();
  like.st_mode = 0644;
  if (const auto now = StateOf(target_))
  {
    // Renaming would replace even a file without write permission, so the permission is checked first.
    if (access(target_.c_str(), W_OK) != 0)
      throw std::runtime_error(
          fmt::format("'{}' is not saved: {}; your changes are still here", path_, std::strerror(errno)));
    like = *now;
  }
  FileBeside beside(target_);
  beside.Fill(text, like);
  beside.TakePlace();
  text_ = text;
  Look();
}

}  // namespace swarmanoid
