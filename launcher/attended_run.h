// A run as a cluster in two processes: the launcher, which the user started and may kill, and one that supervises the
// cluster, which goes on without the launcher for a while (Console). If the supervising one is killed instead, the
// launcher starts another one. `swarmanoid adopt` takes the place of a launcher that has gone.
#pragma once

#include <functional>
#include <optional>

#include "launcher/processes/console.h"
#include "launcher/processes/interrupts.h"
#include "launcher/processes/supervisor.h"

namespace swarmanoid
{

// For whoever supervises: its console, and what the one before has left.
struct Attendance
{
  Console* console = nullptr;  // null: this process is the one that the user started
  Supervisor::GoOn go_on{0, 0};
};

// Does `work` in another process, hands on signals, and returns the exit code. If that process is killed, another one
// starts, `retries` times.
int RunAttended(const ConsoleSetup& setup, unsigned retries, const std::function<int(const Attendance&)>& work);

// Hands the signals of this process to the one at the other end, until that has ended; the exit code of the run, or
// nothing if that process did not come to it. `asked`: whether a signal was handed on. The loss of the terminal ends
// this process.
struct Attended
{
  std::optional<int> exit_code;
  bool asked = false;
};
Attended Attend(ConsoleLink& link, Interrupts& interrupts);

}  // namespace swarmanoid
