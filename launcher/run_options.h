// What `swarmanoid run` was asked to do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/activity/limits.h"

namespace swarmanoid
{

// Which processor cores the processes of a cluster may use.
enum class Placement
{
  kAuto,     // small experiments on one core, others on all
  kOneCore,  // all on one: no wake-up across cores
  kSpread    // wherever the kernel puts them
};

struct RunOptions
{
  std::string experiment;  // the file
  bool single_process = false;
  unsigned controller_hosts = 1;
  std::vector<std::string> engine_hosts;  // "ENGINE=HOST"
  std::string hosts_file;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> ticks;
  std::vector<std::string> settings;  // "PATH=VALUE"
  std::string output;                 // folder of the run; empty: runs/<experiment>-<time>
  std::optional<int> domain;
  double real_time = 0;  // 0: as fast as possible
  bool paused = false;
  std::string events;  // events.csv of an earlier run
  bool no_visualisers = false;
  std::string hash_log;
  std::string expected_hash;
  std::uint64_t checkpoint_every = 0;  // ticks; 0: none
  std::string restore_file;            // empty: from the start
  bool quiet = false;
  Limits limits = LimitsOfEnvironment();
  Placement placement = Placement::kAuto;
};

}  // namespace swarmanoid
