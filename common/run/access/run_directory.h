// The memory that the processes of a run on this machine share: /dev/shm/swarmanoid-<user>/<experiment>-<run>/. It also
// tells which experiments run here. The four programs and the launcher use it.
//
// Every process of the run holds a locked file in the folder, so that folders of dead runs can be told from live ones,
// however their processes ended. Only folders that hold our own mark, belong to this user and are reached without
// following links are used or removed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/run/access/run_key.h"

namespace swarmanoid
{

// Returns the folder of all runs of this user. The environment variable SWARMANOID_SHARED_FOLDER moves it. Other files
// in it stay untouched.
std::string SharedFolder();

// Returns the folder of this user's lock files, which outlive runs. It is in XDG_RUNTIME_DIR, or else in /tmp, and is
// made if needed. Throws BusError.
std::string LockFolder();

// How the processes of a run reach each other. The fields are those of BusOptions.
struct RunNetwork
{
  std::string network_interface = "lo";
  std::vector<std::string> peers{};
  std::string discovery_server{};

  bool operator==(const RunNetwork&) const = default;
};

class RunDirectory
{
public:
  // Joins the run, creating its folder if needed, and removes what dead runs left. Throws BusError.
  RunDirectory(const std::string& experiment, std::uint64_t run);
  // Leaves the run; the server, or else the last process of it on this machine, removes the folder.
  ~RunDirectory() { Leave(); }
  void Leave();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  // For the space server: lets FindLocalRuns find this run with its network. Lets processes of this user find its key.
  void Announce(const std::string& experiment, int domain, const std::optional<RunKey>& key,
                const RunNetwork& network = {});
  // Stores the path of the run's journal for FolderOfRun. Throws BusError.
  void AnnounceFolder(const std::string& folder);
  const std::string& Path() const { return path_; }

private:
  std::string path_;
  std::string name_;    // name of the folder, within SharedFolder()
  std::string marker_;  // name of this process's file, within the folder
  int lock_ = -1;
  bool server_ = false;
};

// Declares that this process shares memory in the folder of a run by messages of Fast DDS. `release`: the release of
// Fast DDS, because each has its own memory layout. Throws BusError if another process of the run has another release.
void RequireSameRelease(const std::string& directory, const std::string& release);

// An experiment whose space server runs on this machine.
struct LocalRun
{
  std::string experiment;
  int domain = 0;
  long server = 0;  // process id
  std::string directory;
  std::string folder{};         // with its journal; empty if it keeps none
  std::optional<RunKey> key{};  // none: every process in the domain belongs to the run
  RunNetwork network{};
};

std::vector<LocalRun> FindLocalRuns();
// Returns the journal folder that the run's space server announced. It is empty if the server runs elsewhere, belongs
// to another user, keeps no journal or has ended.
std::string FolderOfRun(const std::string& experiment, std::uint64_t run);
// Removes the folders of runs without a living process, and nothing else.
void RemoveDeadRuns();

}  // namespace swarmanoid
