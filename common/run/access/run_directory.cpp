// Processes die without cleaning up, so files alone do not tell whether a run is alive. Each process of a run holds a
// lock (flock) on its own file in the folder of the run; the kernel releases it however the process ends. A folder
// whose locks are all free belongs to a dead run, and the next process that makes a RunDirectory removes it.
//
// Invariants: every folder and file within is opened relative to its parent, without following links, and is used only
// if it belongs to this user. Other users can write to no such folder. The mark is written first and removed last, so a
// folder without it is never removed.
#include "common/run/access/run_directory.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include "common/memory/shared_memory.h"
#include "common/run/access/bus_options.h"

namespace swarmanoid
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* kSharedVariable = "SWARMANOID_SHARED_FOLDER";
constexpr const char* kLockVariable = "XDG_RUNTIME_DIR";
constexpr const char* kFolderFile = "folder";  // holds the path of the run's folder on the disk
constexpr const char* kServerFile = "server";
constexpr const char* kKeyFile = "key";
constexpr const char* kNetworkFile = "network";
constexpr const char* kReleaseFile = "fast_dds";
constexpr const char* kMarkerPrefix = "process.";
// Marks every folder that we make for a run. A folder without the mark is not ours and is never removed.
constexpr const char* kRunFile = ".swarmanoid-run";
constexpr std::string_view kRunText = "This folder belongs to a run of Swarmanoid, and is removed with it.\n";

class Descriptor
{
public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor()
  {
    if (number_ >= 0) close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  explicit operator bool() const { return number_ >= 0; }
  int operator*() const { return number_; }
  int Release() { return std::exchange(number_, -1); }

private:
  int number_;
};

// Returns why a folder or file is not ours; nullptr if it is. `status` belongs to an open descriptor.
const char* WhyNotOurs(const struct stat& status)
{
  if (status.st_uid != geteuid()) return "belongs to another user";
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) return "can be written by other users";
  return nullptr;
}

// Opens a folder within `parent` (AT_FDCWD: a path) that is no link and only this user can write. On failure returns an
// empty descriptor. Then errno says why or, if the folder exists and is not ours, `why` does.
Descriptor OpenOwnFolder(int parent, const std::string& name, const char** why = nullptr)
{
  Descriptor folder(openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status
  {
  };
  if (!folder || fstat(*folder, &status) != 0) return Descriptor(-1);
  const char* reason = WhyNotOurs(status);
  if (why != nullptr) *why = reason;
  return reason == nullptr ? std::move(folder) : Descriptor(-1);
}

// Opens a regular file of this user within a folder of this user.
Descriptor OpenOwnFile(int folder, const std::string& name, int flags)
{
  Descriptor file(openat(folder, name.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600));
  struct stat status
  {
  };
  if (!file || fstat(*file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_uid != geteuid())
    return Descriptor(-1);
  return file;
}

std::string TextOf(int folder, const std::string& name)
{
  const Descriptor file = OpenOwnFile(folder, name, O_RDONLY);
  if (!file) return {};
  std::string text(4096, '\0');
  const ssize_t count = read(*file, text.data(), text.size());
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

bool WriteText(int folder, const std::string& name, std::string_view text)
{
  const Descriptor file = OpenOwnFile(folder, name, O_CREAT | O_TRUNC | O_WRONLY);
  return file && write(*file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

std::vector<std::string> NamesIn(int folder)
{
  std::vector<std::string> names;
  // The stream closes its descriptor, so it gets a copy.
  const int copy = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (copy < 0) return names;
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(fdopendir(copy), &closedir);
  if (stream == nullptr)
  {
    close(copy);
    return names;
  }
  while (const dirent* entry = readdir(stream.get()))
    if (const std::string name = entry->d_name; name != "." && name != "..") names.push_back(name);
  return names;
}

int OpenLocked(int folder, const std::string& name, const std::string& path, int flags)
{
  Descriptor file = OpenOwnFile(folder, name, O_CREAT | O_RDWR);
  if (!file) throw BusError("cannot write '" + path + "': " + std::strerror(errno));
  if (flock(*file, flags) == 0) return file.Release();
  return -1;
}

// Opens the folder, and makes it first if it does not exist. `variable`: the environment variable that moves it.
Descriptor MakeOwnFolder(int parent, const std::string& name, const std::string& path, const char* variable)
{
  if (mkdirat(parent, name.c_str(), 0700) != 0 && errno != EEXIST)
    throw BusError("cannot create '" + path + "': " + std::strerror(errno));
  const char* why = nullptr;
  Descriptor folder = OpenOwnFolder(parent, name, &why);
  if (folder) return folder;
  if (why == nullptr)
    why = errno == ELOOP || errno == ENOTDIR ? "is a link or a file, not a folder" : std::strerror(errno);
  throw BusError(fmt::format("'{}' {}; remove it, or name another folder by {}", path, why, variable));
}

// Locks the making and removing of folders, so that no half-made folder is taken for a dead one.
class FolderLock
{
public:
  FolderLock()
  {
    const std::string path = LockFolder();
    const Descriptor folder = MakeOwnFolder(AT_FDCWD, path, path, kLockVariable);
    file_ = OpenLocked(*folder, "folders.lock", path + "/folders.lock", LOCK_EX);
  }
  ~FolderLock() { close(file_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int file_ = -1;
};

bool IsLocked(int folder, const std::string& marker)
{
  const Descriptor file = OpenOwnFile(folder, marker, O_RDWR);
  return file && flock(*file, LOCK_EX | LOCK_NB) != 0;
}

bool HasLiveProcess(int run)
{
  for (const std::string& name : NamesIn(run))
    if (name.starts_with(kMarkerPrefix) && IsLocked(run, name)) return true;
  return false;
}

bool IsRun(int folder) { return TextOf(folder, kRunFile) == kRunText; }

// Removes a run's folder. The files of a run lie flat in it. Other files stay, and then the folder stays, too.
void RemoveRun(int parent, const std::string& name)
{
  const Descriptor run = OpenOwnFolder(parent, name);
  if (!run || !IsRun(*run)) return;
  // The file that marks the folder is removed last, so that the rest of an interrupted removal is recognised.
  for (const std::string& file : NamesIn(*run))
    if (file != kRunFile) unlinkat(*run, file.c_str(), 0);
  const std::vector<std::string> rest = NamesIn(*run);
  if (rest.size() > 1) return;
  unlinkat(*run, kRunFile, 0);
  unlinkat(parent, name.c_str(), AT_REMOVEDIR);
}

// Returns an empty descriptor if the folder does not exist or is not ours.
Descriptor OpenSharedFolder() { return OpenOwnFolder(AT_FDCWD, SharedFolder()); }

// The caller must hold a FolderLock.
void RemoveSharedFolderIfEmpty()
{
  if (OpenSharedFolder()) rmdir(SharedFolder().c_str());
}

// The caller must hold a FolderLock.
void RemoveDeadRunsOf(int shared)
{
  for (const std::string& name : NamesIn(shared))
  {
    const Descriptor folder = OpenOwnFolder(shared, name);
    if (folder && IsRun(*folder) && !HasLiveProcess(*folder)) RemoveRun(shared, name);
  }
}

std::string FileName(const std::string& experiment, std::uint64_t run)
{
  std::string name;
  for (const char c : experiment) name += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' ? c : '_';
  return fmt::format("{}-{:016x}", name.substr(0, 100), run);
}

// Writes one line for the interface, one for the discovery server, and one for each peer.
std::string TextOf(const RunNetwork& network)
{
  std::string text = network.network_interface + "\n" + network.discovery_server + "\n";
  for (const std::string& peer : network.peers) text += peer + "\n";
  return text;
}

RunNetwork NetworkOfText(const std::string& text)
{
  RunNetwork network;
  std::istringstream lines(text);
  if (!std::getline(lines, network.network_interface)) return {};
  std::getline(lines, network.discovery_server);
  for (std::string peer; std::getline(lines, peer);) network.peers.push_back(peer);
  return network;
}

// Returns the folder that AnnounceFolder wrote; empty if none.
std::string FolderIn(int run)
{
  std::istringstream text(TextOf(run, kFolderFile));
  std::string path;
  std::getline(text, path);
  return path;
}

// A slash at the end would make the kernel follow a link.
std::string WithoutSlashes(std::string path)
{
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace

std::string SharedFolder()
{
  const char* elsewhere = std::getenv(kSharedVariable);
  return elsewhere != nullptr && *elsewhere != 0 ? WithoutSlashes(elsewhere)
                                                 : fmt::format("/dev/shm/swarmanoid-{}", geteuid());
}

std::string LockFolder()
{
  const char* runtime = std::getenv(kLockVariable);
  const bool usable = runtime != nullptr && *runtime != 0 && access(runtime, W_OK) == 0;
  const std::string folder = fmt::format("{}/swarmanoid-{}", usable ? runtime : "/tmp", geteuid());
  MakeOwnFolder(AT_FDCWD, folder, folder, kLockVariable);
  return folder;
}

RunDirectory::RunDirectory(const std::string& experiment, std::uint64_t run)
{
  const FolderLock lock;
  const Descriptor shared = MakeOwnFolder(AT_FDCWD, SharedFolder(), SharedFolder(), kSharedVariable);
  // If others start workers on this machine, no launcher removes dead runs here.
  RemoveDeadRunsOf(*shared);
  name_ = FileName(experiment, run);
  path_ = SharedFolder() + "/" + name_;
  const Descriptor folder = MakeOwnFolder(*shared, name_, path_, kSharedVariable);
  // The folder holds the state of the run, in files that the bus makes readable for all.
  if (fchmod(*folder, 0700) != 0)
    throw BusError(fmt::format("cannot keep other users out of '{}': {}", path_, std::strerror(errno)));
  if (!IsRun(*folder) && (!NamesIn(*folder).empty() || !WriteText(*folder, kRunFile, kRunText)))
    throw BusError(fmt::format("'{}' holds other files, or cannot be written; remove it", path_));
  SetSharedMemoryFolder(path_);
  marker_ = fmt::format("{}{}", kMarkerPrefix, getpid());
  lock_ = OpenLocked(*folder, marker_, path_ + "/" + marker_, LOCK_EX | LOCK_NB);
  if (lock_ < 0) throw BusError(fmt::format("'{}/{}' is locked by another process", path_, marker_));
}

void RunDirectory::Leave()
{
  if (lock_ < 0) return;
  try
  {
    const FolderLock lock;
    const Descriptor shared = OpenSharedFolder();
    const Descriptor folder = shared ? OpenOwnFolder(*shared, name_) : Descriptor(-1);
    if (folder) unlinkat(*folder, marker_.c_str(), 0);
    close(lock_);
    lock_ = -1;
    // Processes that still run have what they need mapped.
    if (folder && (server_ || !HasLiveProcess(*folder))) RemoveRun(*shared, name_);
    RemoveSharedFolderIfEmpty();
  }
  catch (const BusError&)
  {
    // Another process has removed the folder of all runs, so nothing is left to tidy.
  }
}

void RunDirectory::Announce(const std::string& experiment, int domain, const std::optional<RunKey>& key,
                            const RunNetwork& network)
{
  const std::string part = std::string(kServerFile) + ".part";
  const Descriptor folder = OpenOwnFolder(AT_FDCWD, path_);
  server_ = true;
  if (folder && key && !WriteText(*folder, kKeyFile, TextOfKey(*key) + "\n"))
    throw BusError("cannot write '" + path_ + "/" + kKeyFile + "': " + std::strerror(errno));
  if (folder && !WriteText(*folder, kNetworkFile, TextOf(network)))
    throw BusError("cannot write '" + path_ + "/" + kNetworkFile + "': " + std::strerror(errno));
  if (!folder || !WriteText(*folder, part, fmt::format("{} {}\n{}\n", domain, getpid(), experiment)) ||
      renameat(*folder, part.c_str(), *folder, kServerFile) != 0)
    throw BusError("cannot write '" + path_ + "/" + kServerFile + "': " + std::strerror(errno));
}

void RunDirectory::AnnounceFolder(const std::string& of_run)
{
  const Descriptor folder = OpenOwnFolder(AT_FDCWD, path_);
  if (!folder || !WriteText(*folder, kFolderFile, of_run + "\n"))
    throw BusError("cannot write '" + path_ + "/" + kFolderFile + "': " + std::strerror(errno));
}

void RequireSameRelease(const std::string& directory, const std::string& release)
{
  // Processes of a run arrive here at the same time.
  const FolderLock lock;
  const Descriptor folder = OpenOwnFolder(AT_FDCWD, directory);
  std::string of_run = folder ? TextOf(*folder, kReleaseFile) : std::string();
  if (of_run == release) return;
  if (folder && of_run.empty() && WriteText(*folder, kReleaseFile, release)) return;
  if (of_run.empty())
    throw BusError(fmt::format("cannot write '{}/{}': {}", directory, kReleaseFile, std::strerror(errno)));
  throw BusError(fmt::format(
      "this program uses Fast DDS {}, and the run on this machine Fast DDS {}: they cannot share memory; start "
      "programs of the same build, or let the run use a network (--interface)",
      release, of_run));
}

std::string FolderOfRun(const std::string& experiment, std::uint64_t run)
{
  const Descriptor shared = OpenSharedFolder();
  const Descriptor folder = shared ? OpenOwnFolder(*shared, FileName(experiment, run)) : Descriptor(-1);
  if (!folder || !IsRun(*folder)) return {};
  return FolderIn(*folder);
}

std::vector<LocalRun> FindLocalRuns()
{
  std::vector<LocalRun> runs;
  const Descriptor shared = OpenSharedFolder();
  if (!shared) return runs;
  for (const std::string& name : NamesIn(*shared))
  {
    const Descriptor folder = OpenOwnFolder(*shared, name);
    if (!folder || !IsRun(*folder)) continue;
    std::istringstream text(TextOf(*folder, kServerFile));
    LocalRun run;
    run.directory = SharedFolder() + "/" + name;
    if (!(text >> run.domain >> run.server)) continue;
    text.ignore();
    std::getline(text, run.experiment);
    run.folder = FolderIn(*folder);
    run.key = KeyOfText(TextOf(*folder, kKeyFile));
    run.network = NetworkOfText(TextOf(*folder, kNetworkFile));
    if (IsLocked(*folder, fmt::format("{}{}", kMarkerPrefix, run.server))) runs.push_back(run);
  }
  return runs;
}

void RemoveDeadRuns()
{
  if (!OpenSharedFolder()) return;
  const FolderLock lock;
  const Descriptor shared = OpenSharedFolder();
  if (!shared) return;
  RemoveDeadRunsOf(*shared);
  RemoveSharedFolderIfEmpty();
}

}  // namespace swarmanoid
