// The program that runs one physics engine of an experiment: the engine worker's role at the bus.
#include "common/bus/membership/worker_program.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "engine_worker/cluster/engine_node.h"
#include "engine_worker/engine_worker.h"

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  const ProgramDescription program{
      "engine_worker",
      "Runs one physics engine of a Swarmanoid experiment.",
      "Examples:\n"
      "  engine_worker --engine ground                              the experiment that runs on this machine\n"
      "  engine_worker --engine ground --experiment diffusion_10 --domain 7\n"
      "  engine_worker --engine ground --region 1                   one region of an engine that is split\n"
      "  engine_worker --engine ground --interface eth0             space server on another machine",
      []
      {
        DescribeBuiltins();
        RegisterBuiltinEngines();
      },
      true,
      true};
  return RunWorker(program, count, arguments, EngineOptionTable, RunEngineWorker);
}
