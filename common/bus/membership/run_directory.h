// The memory that the processes of a run on this machine share: /dev/shm/swarmanoid-<user>/<experiment>-<run>/. It also
// tells which experiments run here. Used by the four programs and the launcher.
//
// Every process of the run holds a locked file in the folder, so that folders of dead runs can be told from live ones,
// however their processes ended. Only folders that hold our own mark, belong to this user and are reached without
// following links are used or removed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/security/run_key.h"

namespace swarmanoid
{

// The folder of all runs of this user. The environment variable SWARMANOID_SHARED_FOLDER puts it elsewhere; what else
// lies there stays untouched.
std::string SharedFolder();

// Where the lock files of this user are, which outlive runs: in XDG_RUNTIME_DIR, or else in /tmp. Made if needed.
// Throws BusError.
std::string LockFolder();

// How the processes of a run reach each other, as BusOptions has it.
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

  // For the space server: lets FindLocalRuns find this run with its network, and processes of this user its key.
  void Announce(const std::string& experiment, int domain, const std::optional<RunKey>& key,
                const RunNetwork& network = {});
  // Where the run keeps its journal, for FolderOfRun. Throws BusError.
  void AnnounceFolder(const std::string& folder);
  const std::string& Path() const { return path_; }

private:
  std::string path_;
  std::string name_;    // of the folder, within SharedFolder()
  std::string marker_;  // of this process, within the folder
  int lock_ = -1;
  bool server_ = false;
};

// Says that this process shares memory in the folder of a run by messages of Fast DDS. `release`: of Fast DDS, since
// each release lays its memory out in its own way. Throws BusError if another process of the run has another release.
void RequireSameRelease(const std::string& directory, const std::string& release);

// An experiment whose space server runs on this machine.
struct LocalRun
{
  std::string experiment;
  int domain = 0;
  long server = 0;  // process id
  std::string directory;
  std::string folder{};         // with its journal; empty: it keeps none
  std::optional<RunKey> key{};  // none: whoever is in the domain belongs to it
  RunNetwork network{};
};

std::vector<LocalRun> FindLocalRuns();
// As its space server announced it; empty if it runs elsewhere, belongs to another user, keeps no journal or is over.
std::string FolderOfRun(const std::string& experiment, std::uint64_t run);
// Removes the folders of runs of which no process is alive, and nothing else.
void RemoveDeadRuns();

}  // namespace swarmanoid
