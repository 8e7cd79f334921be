// A run in a user's program that loads an experiment of ARGoS3 and steps it itself (CSimulator::LoadExperiment). The
// library loads this code when a program needs it, so that controllers and loop functions do not need the launcher.
#include "argos3/converter/convert.h"
#include "argos3/library/running.h"
#include "launcher/argos3_dry_run.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid::argos3
{
namespace
{

class Run : public ProgramRun
{
public:
  explicit Run(const std::string& file) : experiment_(Read(file)), simulator_(*experiment_, Unseen()) {}
  SpaceEditor& Editor() override { return simulator_.GetEditor(); }
  void Step() override { simulator_.Step(); }
  void Finish() override { simulator_.Finish(); }

private:
  static SimulatorOptions Unseen()
  {
    SimulatorOptions options;
    options.visualisations = false;
    return options;
  }
  // The experiment has no end here, since the loop functions know the length of each trial.
  static std::unique_ptr<Experiment> Read(const std::string& file)
  {
    static const bool reads = []
    {
      ReadArgos3Experiments(RehearseArgos3);
      return true;
    }();
    static_cast<void>(reads);
    std::unique_ptr<Experiment> experiment = ReadExperiment(file);
    TheRunning().program_length = experiment->max_clock;
    experiment->max_clock = 0;
    return experiment;
  }

  std::unique_ptr<Experiment> experiment_;
  CSimulator simulator_;
};

const bool registered = []
{
  TheRunning().load = [](const std::string& file) -> std::unique_ptr<ProgramRun>
  { return std::make_unique<Run>(file); };
  return true;
}();

}  // namespace
}  // namespace swarmanoid::argos3
