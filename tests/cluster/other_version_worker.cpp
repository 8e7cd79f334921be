// Stands in for an engine_worker of another version. It joins the run with another protocol, is refused, and reports
// that as workers do.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include "common/bus/bus.h"
#include "common/errors/exit_codes.h"
#include "idl/messages.h"

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  BusOptions options;
  std::string experiment, name;
  for (int k = 1; k + 1 < count; ++k)
  {
    const std::string_view word = arguments[k];
    if (word == "--domain") options.domain = std::stoi(arguments[k + 1]);
    if (word == "--interface") options.network_interface = arguments[k + 1];
    if (word == "--key-fd") options.key_fd = std::stoi(arguments[k + 1]);
    if (word == "--experiment") experiment = arguments[k + 1];
    if (word == "--engine") name = fmt::format("engine '{}'", arguments[k + 1]);
  }
  Bus bus(options, name);
  std::atomic<std::uint64_t> run = 0;
  std::atomic<bool> refused = false;
  Publisher<JoinMessage> joins(bus, experiment);
  const Subscription<LeaveMessage> leaves(bus, experiment,
                                          [&](const LeaveMessage& leave)
                                          {
                                            if (leave.process != ProcessId() || leave.error.empty()) return;
                                            fmt::print(stderr, "{}: {}\n", name, leave.error);
                                            refused = true;
                                          });
  const Subscription<WorldMessage> worlds(bus, experiment, [&](const WorldMessage& world) { run = world.run; });
  // A test that waits in vain kills this process.
  while (run == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  joins.Write({ProcessId(), kProtocolVersion + 1, run, name, false});
  while (!refused) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return kExitProcessFailed;
}
