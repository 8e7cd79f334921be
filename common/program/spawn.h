// Starting another program: the one place that does. Used by processes of clusters (process.h), the launcher and
// studies; in any thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace swarmanoid
{

struct SpawnSettings
{
  std::vector<std::string> words;  // the program first, by its path or as it is found on the PATH
  std::string name{};              // for the user: "engine_worker ground"; empty: the program
  std::vector<std::pair<std::string, std::string>> environment{};  // added to ours
  // Descriptors that become its standard ones; -1: /dev/null.
  int input = -1;
  int output = -1;
  int errors = -1;
  int kept = -1;             // one more descriptor that it inherits, by its number
  std::vector<int> cores{};  // that it may run on; empty: all
  // It leads a process group of its own: Ctrl-C at a terminal is not for it.
  bool leads_group = false;
  // The kernel sends it this signal when the thread that started it ends; 0: none.
  int signal_at_our_end = 0;
};

// The program runs when this returns. It inherits no descriptors but those above, ignores and blocks no signals.
// Whoever calls waits for the process. Throws std::runtime_error: "cannot start NAME: 'PROGRAM': reason".
pid_t Spawn(const SpawnSettings& settings);

}  // namespace swarmanoid
