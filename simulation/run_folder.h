// The folder of one run: runs/<experiment>-<time>/ with the effective experiment, the manifest, the logs and all
// outputs.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace swarmanoid
{

class RunFolderError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class RunFolder
{
public:
  // Makes the folder `asked`, which must be new or empty. If `asked` is empty, makes a new folder under runs/, named by
  // the experiment and the time. Throws RunFolderError with the cure.
  RunFolder(const std::string& asked, const std::string& experiment);

  const std::string& Path() const { return path_; }  // absolute
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  // Writes a whole file. Throws RunFolderError if that fails; an old file of that name then stays.
  void Write(const std::string& name, const std::string& text) const;
  // Lets the link `latest` beside a folder under runs/ name this run. If that is not possible, only the link is
  // missing.
  void BecomeLatest() const;

private:
  std::string path_;
  bool is_under_runs_;
};

// The origin of a run that branched off another one.
struct BranchOrigin
{
  std::string run;  // folder of the other run
  std::uint64_t tick = 0;
  std::uint64_t hash = 0;        // hash of the other run's state at the tick
  std::uint64_t first_tick = 0;  // first tick of the branch
  std::vector<std::string> changes;
};

// The origin of a run that began again after a reset.
struct ResetOrigin
{
  std::string run;  // folder of the run that was reset
  std::uint64_t tick = 0;
  bool paused = false;
  double real_time_factor = 0;
};

// It is the content of manifest.json: the settings of a run and its result. docs/command.md describes the fields.
struct Manifest
{
  std::string experiment;
  std::string file;
  std::uint64_t experiment_hash = 0;  // XXH3-64 of experiment.xml
  std::uint64_t seed = 0;
  std::vector<std::string> command;
  std::vector<std::pair<std::string, std::string>> libraries;  // name and build-id of all code that computes the state
  std::string started;
  std::string hash_log;       // its absolute path; empty: none
  std::string restored_from;  // the absolute path of the checkpoint that the run began with; empty: none
  std::optional<BranchOrigin> branch_of;
  std::optional<ResetOrigin> reset_of;
  std::optional<int> domain;                                   // clusters only
  std::vector<std::pair<std::string, std::string>> processes;  // name and log

  // The fields below are known at the end.
  std::string ended;
  std::optional<int> exit_code;
  std::optional<std::uint64_t> ticks;
  std::optional<std::uint64_t> state_hash;
  double wall_s = 0;
  double real_time_factor = 0;
  unsigned threads = 0;            // one process only
  std::uint64_t shared_ticks = 0;  // that all threads did
  std::string failure;

  std::string Text() const;
};

// Reads the manifest of a run that has ended. Throws std::exception.
nlohmann::json ReadManifest(const std::string& folder);

// Returns the local time as 2031-05-17T09:30:00+0200.
std::string TimeStamp();
std::uint64_t TextHash(const std::string& text);

}  // namespace swarmanoid
