// BusLibrary: the parts of the launcher that take part in a run over DDS. They are in the library launcher_bus, which
// is loaded when the first of them is needed. A run in one process never loads it, nor does the command that starts a
// cluster: Fast DDS takes half of the start of a process.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/run/access/access_grant.h"
#include "idl/messages.h"
#include "launcher/supervision/prepared_run.h"
#include "simulation/run_link.h"

namespace swarmanoid
{

struct RunAnswer
{
  bool may_speak = true;                     // whether this process holds the key of the run, or needs none
  std::optional<ControlReplyMessage> reply;  // none: the run does not answer
  std::optional<RunStatus> status;           // of the run, as received last
  std::uint64_t dropped = 0;                 // messages that were not understood
};

class BusLibrary
{
public:
  virtual ~BusLibrary() = default;

  // Joins the bus as the process of that name, and sends an order to a run. The reply comes within `patience_s` if the
  // run does not stand still. Throws BusError.
  virtual RunAnswer Ask(const BusOptions& options, const std::string& name, const std::string& experiment,
                        const ControlOrder& order, double patience_s) const = 0;
  // Returns the channel of a grant, with its own key. Throws BusError.
  virtual GrantChannel ChannelOf(const RunKey& run_key, const AccessGrant& grant) const = 0;
  // Returns the link by which users outside of this process watch and steer a run in it. `run` has a domain, and must
  // outlive the link. Without a key every process in the domain may take part.
  virtual std::unique_ptr<RunLink> LinkOf(const PreparedRun& run, const std::optional<RunKey>& key) const = 0;
  // Runs the program of the space server in this process and thread, with the user's watch function. `words`: its
  // command line. `status`: the descriptor for status lines. The flags end the run after its tick, and at once.
  // Returns the exit code.
  virtual int Serve(std::vector<std::string> words, int status, const std::atomic<bool>& stop,
                    const std::atomic<bool>& abandon, const std::optional<RunKey>& key,
                    const WatchFunction& watch) const = 0;
};

// The library has this function. LoadBusLibrary calls it.
extern "C" const BusLibrary& SwarmanoidBusLibrary();

// Loads the library unless this process has it. Throws std::runtime_error if it is missing.
const BusLibrary& LoadBusLibrary();

}  // namespace swarmanoid
