#include "common/configuration/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "common/configuration/shown_text.h"
#include "common/configuration/trust.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr mode_t kAnybody = 0777;
constexpr std::size_t kShownBytes = 1000;
constexpr const char* kManifest = "manifest.json";  // exists in the folder of a run before its first tick
constexpr const char* kCure = ", or trust the experiment by --trust";

class Folder
{
public:
  explicit Folder(int descriptor) : descriptor_(descriptor) {}
  ~Folder()
  {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Folder(Folder&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Folder& operator=(Folder&& other) noexcept
  {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  bool IsOpen() const { return descriptor_ >= 0; }
  int operator*() const { return descriptor_; }
  // Reads the status of the file of that name, without following a link. Returns false with errno if it does not exist.
  bool Stat(const std::string& name, struct stat& status) const
  {
    return fstatat(descriptor_, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
  }

private:
  int descriptor_;
};

// The files that this process has made, by absolute path.
class MadeFiles
{
public:
  static MadeFiles& Instance()
  {
    static MadeFiles made;
    return made;
  }
  void Add(const std::string& path)
  {
    const std::lock_guard lock(mutex_);
    paths_.insert(path);
  }
  bool Has(const std::string& path)
  {
    const std::lock_guard lock(mutex_);
    return paths_.contains(path);
  }

private:
  std::mutex mutex_;  // guards paths_
  std::set<std::string> paths_;
};

[[noreturn]] void Refuse(const std::string& path, const std::string& why)
{
  throw OutputFileError("'" + ShowableLine(path, kShownBytes) + "' " + why);
}

[[noreturn]] void RefuseLink(const std::string& path)
{
  Refuse(path, std::string("is a link, which is not followed: remove it") + kCure);
}

// Returns the parts of a name below a folder. Throws OutputFileError.
std::vector<std::string> PartsOf(const std::string& name)
{
  const fs::path path(name);
  std::vector<std::string> parts;
  bool leaves = path.is_absolute() || name.empty() || name.ends_with('/') || name.find('\0') != std::string::npos;
  for (const fs::path& part : path)
  {
    leaves |= part == "..";
    if (part != ".") parts.push_back(part.string());
  }
  if (leaves || parts.empty())
    Refuse(name, std::string("is no file below the folder of the run: write a relative name without ..") + kCure);
  return parts;
}

Folder OpenRoot(const std::string& folder)
{
  return Folder(open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

std::string AbsolutePath(const std::string& folder, const std::string& name)
{
  return fs::absolute(fs::path(folder) / name).lexically_normal().string();
}

// Throws OutputFileError if the file of `path` in the folder `parent` must not be replaced. Returns false if the file
// does not exist.
bool MayReplace(const Folder& root, const Folder& parent, const std::string& file, const std::string& path)
{
  struct stat status
  {
  };
  if (!parent.Stat(file, status))
  {
    if (errno == ENOENT) return false;
    Refuse(path, std::strerror(errno));
  }
  if (S_ISLNK(status.st_mode)) RefuseLink(path);
  if (!S_ISREG(status.st_mode)) Refuse(path, std::string("is no file: remove it") + kCure);
  struct stat manifest
  {
  };
  // The folder of a run was empty when the run began, so all files in it are the run's.
  const bool is_of_run = status.st_uid == geteuid() && status.st_nlink == 1 && root.Stat(kManifest, manifest) &&
                         S_ISREG(manifest.st_mode) && manifest.st_uid == geteuid();
  if (!is_of_run && !MadeFiles::Instance().Has(path))
    Refuse(
        path,
        std::string("is there, and was not made by this run: remove it, choose another folder for the output") + kCure);
  return true;
}

std::atomic<bool> user_names_files{false};

bool AreFree() { return user_names_files || ExperimentsAreTrusted(); }

}  // namespace

void LetUserNameFiles() { user_names_files = true; }

int OpenOutput(const std::string& path, int flags) { return open(path.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, 0666); }

std::FILE* OpenOutputFile(const std::string& path, bool appends)
{
  const int file = OpenOutput(path, O_WRONLY | O_CREAT | (appends ? O_APPEND : O_TRUNC));
  if (file < 0) return nullptr;
  std::FILE* const stream = fdopen(file, appends ? "a" : "w");
  if (stream == nullptr) close(file);
  return stream;
}

std::string OutputFolderMistake(const std::string& path)
{
  struct stat status
  {
  };
  if (stat(path.c_str(), &status) != 0) return {};
  if (status.st_uid != geteuid()) return "it belongs to another user, who could have your files replaced";
  if ((status.st_mode & S_IWOTH) != 0 && (status.st_mode & S_ISVTX) == 0)
    return "all users can write there (chmod o-w)";
  return {};
}

void OutputFiles::Check(const std::string& name) const
{
  if (AreFree()) return;
  const std::vector<std::string> parts = PartsOf(name);
  const Folder root = OpenRoot(folder_);
  if (!root.IsOpen()) return;
  Folder parent = OpenRoot(folder_);
  for (std::size_t k = 0; k + 1 < parts.size(); ++k)
  {
    struct stat status
    {
    };
    if (!parent.Stat(parts[k], status)) return;
    if (S_ISLNK(status.st_mode)) RefuseLink(AbsolutePath(folder_, parts[k]));
    Folder next(openat(*parent, parts[k].c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!next.IsOpen()) return;
    parent = std::move(next);
  }
  MayReplace(root, parent, parts.back(), AbsolutePath(folder_, name));
}

std::string OutputFiles::Claim(const std::string& name) const
{
  const std::string whole = (fs::path(folder_) / name).string();
  if (AreFree())
  {
    std::error_code ignored;  // a folder that cannot be made gives an error at the file
    if (const fs::path above = fs::path(whole).parent_path(); !above.empty()) fs::create_directories(above, ignored);
    return whole;
  }
  const std::vector<std::string> parts = PartsOf(name);
  std::error_code ignored;
  if (!folder_.empty()) fs::create_directories(folder_, ignored);
  const Folder root = OpenRoot(folder_);
  Folder parent = OpenRoot(folder_);
  if (!root.IsOpen() || !parent.IsOpen()) Refuse(folder_, std::strerror(errno));
  for (std::size_t k = 0; k + 1 < parts.size(); ++k)
  {
    if (mkdirat(*parent, parts[k].c_str(), kAnybody) != 0 && errno != EEXIST) Refuse(whole, std::strerror(errno));
    Folder next(openat(*parent, parts[k].c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!next.IsOpen() && (errno == ELOOP || errno == ENOTDIR)) RefuseLink(AbsolutePath(folder_, parts[k]));
    if (!next.IsOpen()) Refuse(whole, std::strerror(errno));
    parent = std::move(next);
  }
  const std::string path = AbsolutePath(folder_, name);
  if (MayReplace(root, parent, parts.back(), path)) return whole;
  const Folder file(openat(*parent, parts.back().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (!file.IsOpen()) Refuse(path, std::strerror(errno));
  MadeFiles::Instance().Add(path);
  return whole;
}

}  // namespace swarmanoid
