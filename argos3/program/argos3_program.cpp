// A run in a user's program that loads an experiment of ARGoS3 and steps it itself (CSimulator::LoadExperiment). The
// library loads this code when a program needs it, so that controllers and loop functions do not need the launcher.
#include <filesystem>

#include "argos3/converter/convert.h"
#include "argos3/library/running.h"
#include "launcher/argos3_dry_run.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid::argos3
{
namespace
{

class Run : public ProgramRun
{
public:
  Run(const std::string& file, const std::string* text)
      : experiment_(Read(file, text)), simulator_(*experiment_, Unseen())
  {
  }
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
  static std::unique_ptr<Experiment> Read(const std::string& file, const std::string* text)
  {
    static const bool reads = []
    {
      ReadArgos3Experiments(RehearseArgos3);
      return true;
    }();
    static_cast<void>(reads);
    std::unique_ptr<Experiment> experiment = text == nullptr ? ReadExperiment(file) : OfText(file, *text);
    TheRunning().program_length = experiment->max_clock;
    experiment->max_clock = 0;
    return experiment;
  }

  static std::unique_ptr<Experiment> OfText(const std::string& file, const std::string& text)
  {
    RegisterBuiltins();
    const std::string folder = std::filesystem::absolute(file).parent_path().lexically_normal().string();
    LoadedExperiment loaded = LoadExperimentText(text, file, folder);
    if (loaded.experiment) return std::move(loaded.experiment);
    std::string mistakes;
    for (const Diagnostic& error : loaded.errors) mistakes += (mistakes.empty() ? "" : "\n") + error.Text();
    throw ConfigurationError(mistakes);
  }

  std::unique_ptr<Experiment> experiment_;
  CSimulator simulator_;
};

const bool registered = []
{
  TheRunning().load = [](const std::string& file, const std::string* text) -> std::unique_ptr<ProgramRun>
  { return std::make_unique<Run>(file, text); };
  return true;
}();

}  // namespace
}  // namespace swarmanoid::argos3
