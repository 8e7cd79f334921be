#include "common/bus/worker_program.h"

#include <initializer_list>

#include "common/bus/offered_machine.h"
#include "common/program/trust_flag.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

using RunFunction = std::function<int(const WorkerSettings&, const BusOptions&)>;

int RunWithTables(const ProgramDescription& program, int count, char** arguments,
                  std::initializer_list<WorkerTable> tables, const RunFunction& run,
                  const std::function<void(CLI::App&)>& declare = nullptr)
{
  WorkerSettings settings;
  BusOptions bus;
  return RunProgram(
      program, count, arguments,
      [&](CLI::App& app)
      {
        for (const WorkerTable table : tables) AddOptions(app, table(settings));
        AddOptions(app, BusOptionTable(bus));
        AddTrustFlag(app);
        if (declare) declare(app);
      },
      [&] { return run(settings, bus); });
}

}  // namespace

int RunWorker(const ProgramDescription& program, int count, char** arguments, WorkerTable table, const RunFunction& run,
              const std::function<void(CLI::App&)>& declare)
{
  return RunWithTables(program, count, arguments, {table}, run, declare);
}

int RunMovableWorker(const ProgramDescription& program, int count, char** arguments, WorkerTable table,
                     const RunFunction& run)
{
  return RunWithTables(
      program, count, arguments, {table, OfferOptionTable},
      [&](const WorkerSettings& settings, const BusOptions& bus)
      {
        if (!settings.through.empty()) return RunThroughMachine(program.name, table, settings, bus);
        if (settings.offer.empty()) return run(settings, bus);
        WorkerSettings others = settings;
        others.experiment.clear();
        if (const std::vector<std::string> words = WorkerWords(table, others); !words.empty())
          throw UsageError(fmt::format(
              "{}: the run says which workers run on a machine that is offered, and how; leave it out", words[0]));
        return OfferMachine(settings, bus);
      });
}

}  // namespace swarmanoid
