#include "launcher/supervision/bus_library.h"

#include "common/bus/membership/control_client.h"
#include "common/bus/security/derived_key.h"
#include "common/program/program.h"
#include "launcher/bus/run_on_bus.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/cluster/server_main.h"

namespace swarmanoid
{
namespace
{

class OwnBusLibrary : public BusLibrary
{
public:
  RunAnswer Ask(const BusOptions& options, const std::string& name, const std::string& experiment,
                const ControlOrder& order, double patience_s) const override
  {
    Bus bus(options, name, experiment);
    RunAnswer answer;
    answer.may_speak = bus.MaySpeakTo(experiment);
    if (!answer.may_speak) return answer;
    ControlClient client(bus, experiment);
    answer.reply = client.Ask(order, patience_s);
    answer.status = client.LatestStatus();
    answer.dropped = bus.Dropped();
    return answer;
  }

  GrantChannel ChannelOf(const RunKey& run_key, const AccessGrant& grant) const override
  {
    return swarmanoid::ChannelOf(run_key, grant);
  }

  std::unique_ptr<RunLink> LinkOf(const PreparedRun& run, const std::optional<RunKey>& key) const override
  {
    return std::make_unique<RunOnBus>(run, key);
  }

  int Serve(std::vector<std::string> words, int status, const std::atomic<bool>& stop, const std::atomic<bool>& abandon,
            const std::optional<RunKey>& key, const WatchFunction& watch) const override
  {
    ServerOptions options;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    return RunProgram(
        {"space_server", "", "", RegisterBuiltins, false, true}, static_cast<int>(arguments.size()), arguments.data(),
        [&](CLI::App& app) { AddServerOptions(app, options); },
        [&]
        {
          options.status_fd = status;
          options.bus.key = key;
          options.stop = &stop;
          options.abandon = &abandon;
          options.watch = [watch](SpaceServer& server)
          {
            CSimulator simulator = WatchedSimulator::Of(server);
            watch(simulator);
          };
          return swarmanoid::Serve(options);
        });
  }
};

}  // namespace

const BusLibrary& SwarmanoidBusLibrary()
{
  static const OwnBusLibrary library;
  return library;
}

}  // namespace swarmanoid
