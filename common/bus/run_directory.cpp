#include "common/bus/run_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/activity/shared_memory.h"
#include "common/bus/bus.h"

namespace swarmanoid
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* kServerFile = "server";
constexpr const char* kMarkerPrefix = "process.";

int OpenLocked(const std::string& path, int flags)
{
  const int file = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0) throw BusError("cannot write '" + path + "': " + std::strerror(errno));
  if (flock(file, flags) == 0) return file;
  close(file);
  return -1;
}

// Held while folders are made or removed, so that no half-made folder is taken for a dead one.
class FolderLock
{
public:
  FolderLock() : file_(OpenLocked(LockFolder() + "/folders.lock", LOCK_EX)) {}
  ~FolderLock() { close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int file_;
};

bool IsLocked(const fs::path& marker)
{
  const int file = open(marker.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return errno == EACCES;
  const bool locked = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return locked;
}

bool HasLiveProcess(const fs::path& run)
{
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(run, error))
    if (entry.path().filename().string().starts_with(kMarkerPrefix) && IsLocked(entry.path())) return true;
  return false;
}

std::vector<fs::path> RunFolders()
{
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(SharedFolder(), error))
    if (entry.is_directory(error)) folders.push_back(entry.path());
  return folders;
}

void MakeOwnFolder(const std::string& folder)
{
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw BusError("cannot create '" + folder + "': " + std::strerror(errno));
  struct stat status
  {
  };
  if (stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != getuid())
    throw BusError("'" + folder + "' is not a folder of this user; remove it");
}

// With a FolderLock.
void RemoveSharedFolderIfEmpty() { rmdir(SharedFolder().c_str()); }

std::string FileName(const std::string& experiment, std::uint64_t run)
{
  std::string name;
  for (const char c : experiment) name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' ? c : '_';
  return fmt::format("{}-{:016x}", name.substr(0, 100), run);
}

}  // namespace

std::string SharedFolder()
{
  const char* elsewhere = std::getenv("SWARMANOID_SHARED_FOLDER");
  return elsewhere != nullptr && *elsewhere != 0 ? elsewhere : fmt::format("/dev/shm/swarmanoid-{}", getuid());
}

std::string LockFolder()
{
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const bool usable = runtime != nullptr && *runtime != 0 && access(runtime, W_OK) == 0;
  const std::string folder = fmt::format("{}/swarmanoid-{}", usable ? runtime : "/tmp", getuid());
  MakeOwnFolder(folder);
  return folder;
}

RunDirectory::RunDirectory(const std::string& experiment, std::uint64_t run)
{
  const FolderLock lock;
  MakeOwnFolder(SharedFolder());
  path_ = SharedFolder() + "/" + FileName(experiment, run);
  if (mkdir(path_.c_str(), 0700) != 0 && errno != EEXIST)
    throw BusError("cannot create '" + path_ + "': " + std::strerror(errno));
  SetSharedMemoryFolder(path_);
  marker_ = fmt::format("{}/{}{}", path_, kMarkerPrefix, getpid());
  lock_ = OpenLocked(marker_, LOCK_EX | LOCK_NB);
  if (lock_ < 0) throw BusError("'" + marker_ + "' is locked by another process");
}

void RunDirectory::Leave()
{
  if (lock_ < 0) return;
  try
  {
    const FolderLock lock;
    unlink(marker_.c_str());
    close(lock_);
    lock_ = -1;
    std::error_code error;
    // Processes that still run have what they need mapped.
    if (server_ || !HasLiveProcess(path_)) fs::remove_all(path_, error);
    RemoveSharedFolderIfEmpty();
  }
  catch (const BusError&)
  {
    // The folder of all runs has been removed by someone else: nothing is left to tidy.
  }
}

void RunDirectory::Announce(const std::string& experiment, int domain)
{
  const std::string part = path_ + "/" + kServerFile + ".part";
  {
    std::ofstream file(part);
    file << domain << ' ' << getpid() << '\n' << experiment << '\n';
  }
  std::error_code error;
  fs::rename(part, path_ + "/" + kServerFile, error);
  server_ = true;
  if (error) throw BusError("cannot write '" + path_ + "/" + kServerFile + "': " + error.message());
}

std::vector<LocalRun> FindLocalRuns()
{
  std::vector<LocalRun> runs;
  for (const fs::path& folder : RunFolders())
  {
    std::ifstream file(folder / kServerFile);
    LocalRun run;
    run.directory = folder.string();
    if (!(file >> run.domain >> run.server)) continue;
    file.ignore();
    std::getline(file, run.experiment);
    if (IsLocked(folder / fmt::format("{}{}", kMarkerPrefix, run.server))) runs.push_back(run);
  }
  return runs;
}

void RemoveDeadRuns()
{
  if (!fs::is_directory(SharedFolder())) return;
  const FolderLock lock;
  std::error_code error;
  for (const fs::path& folder : RunFolders())
    if (!HasLiveProcess(folder)) fs::remove_all(folder, error);
  RemoveSharedFolderIfEmpty();
}

}  // namespace swarmanoid
