#include "common/bus/membership/worker_program.h"

#include "common/program/trust_flag.h"

namespace swarmanoid
{

int RunWorker(const ProgramDescription& program, int count, char** arguments, WorkerTable table,
              const std::function<int(const WorkerSettings&, const BusOptions&)>& run,
              const std::function<void(CLI::App&)>& declare)
{
  WorkerSettings settings;
  BusOptions bus;
  return RunProgram(
      program, count, arguments,
      [&](CLI::App& app)
      {
        AddOptions(app, table(settings));
        AddOptions(app, BusOptionTable(bus));
        AddTrustFlag(app);
        if (declare) declare(app);
      },
      [&] { return run(settings, bus); });
}

}  // namespace swarmanoid
