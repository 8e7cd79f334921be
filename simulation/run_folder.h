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
  // Makes the folder: `asked` itself, which must be new or empty, or if that is empty, a new one of the experiment's
  // name and the time under runs/. Throws RunFolderError with the cure.
  RunFolder(const std::string& asked, const std::string& experiment);

  const std::string& Path() const { return path_; }  // absolute
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  // Writes a whole file, or throws RunFolderError and leaves the one that was there.
  void Write(const std::string& name, const std::string& text) const;
  // Lets the link `latest` beside a folder under runs/ name this run. It costs only the link if that is not possible.
  void BecomeLatest() const;

private:
  std::string path_;
  bool is_under_runs_;
};

// The run that another one branched off.
struct BranchOrigin
{
  std::string run;  // its folder
  std::uint64_t tick = 0;
  std::uint64_t hash = 0;        // of its state there
  std::uint64_t first_tick = 0;  // of the branch
  std::vector<std::string> changes;
};

// The run that was reset, and so began again as this one.
struct ResetOrigin
{
  std::string run;  // its folder
  std::uint64_t tick = 0;
  bool paused = false;
  double real_time_factor = 0;
};

// manifest.json: what was run, how, and what came of it. docs/command.md describes the fields.
struct Manifest
{
  std::string experiment;
  std::string file;
  std::uint64_t experiment_hash = 0;  // XXH3-64 of experiment.xml
  std::uint64_t seed = 0;
  std::vector<std::string> command;
  std::vector<std::pair<std::string, std::string>> libraries;  // name and build-id, of all that computes the state
  std::string started;
  std::optional<BranchOrigin> branch_of;
  std::optional<ResetOrigin> reset_of;
  std::optional<int> domain;                                   // clusters only
  std::vector<std::pair<std::string, std::string>> processes;  // name and log

  // Known at the end.
  std::string ended;
  std::optional<int> exit_code;
  std::optional<std::uint64_t> ticks;
  std::optional<std::uint64_t> state_hash;
  double wall_s = 0;
  double real_time_factor = 0;
  std::string failure;

  std::string Text() const;
};

// Of the folder of a run that has ended. Throws std::exception.
nlohmann::json ReadManifest(const std::string& folder);

// Local time as 2031-05-17T09:30:00+0200.
std::string TimeStamp();
std::uint64_t TextHash(const std::string& text);

}  // namespace swarmanoid
