// Starts another program. All other code calls this function: processes of clusters (process.h), the launcher and
// studies, in any thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace swarmanoid
{

struct SpawnSettings
{
  std::vector<std::string> words;  // the program first, as a path or a name on the PATH
  std::string name{};              // for the user: "engine_worker ground"; empty: the program
  std::vector<std::pair<std::string, std::string>> environment{};  // added to this process's environment
  // The descriptors that become its standard ones; -1: /dev/null.
  int input = -1;
  int output = -1;
  int errors = -1;
  int kept = -1;             // one more descriptor that it inherits, with the same number
  std::vector<int> cores{};  // cores that it may run on; empty: all
  // It leads its own process group, so that Ctrl-C at a terminal does not reach it.
  bool leads_group = false;
  // The signal that the kernel sends it when the thread that started it ends; 0: none.
  int signal_at_our_end = 0;
};

// Starts the program and returns when it runs. It inherits only the descriptors above, and ignores and blocks no
// signals. The caller waits for the process. Throws std::runtime_error: "cannot start NAME: 'PROGRAM': reason".
pid_t Spawn(const SpawnSettings& settings);

}  // namespace swarmanoid
