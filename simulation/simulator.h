// CSimulator: the abstract algorithm of the simulator. All roles of an experiment in this process, called in turn, one
// tick at a time: no DDS, no copies, same results as a cluster. For `swarmanoid run --single-process`, for tests, and
// for the programs of users that look at every tick or run an experiment many times. One thread.
//
//   const auto experiment = ReadExperiment("experiments/retrieval.xml", {{"framework.seed", "3"}});
//   CSimulator simulator(*experiment);
//   while (simulator.Step()) best = std::max(best, simulator.GetSpace().FindEntity("fb")->GetPosition().x());
//   simulator.Finish();
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/run/run_settings.h"
#include "common/run/run_summary.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

class SpaceEditor;
class SpaceServer;
struct Checkpoint;

class CSimulator
{
public:
  // The experiment at tick 0, or where its checkpoint is; it must outlive the simulator. Throws ConfigurationError,
  // ActivityError (common/activity/failure_report.h), which names whose code failed, or another std::runtime_error with
  // a text for the user; so do Sense, Step and Finish. Code that crashes or calls exit ends the program with such a
  // line and exit code 4. The function that RunSimulation calls at each tick gets one too, only to look at: there Step
  // and Finish throw std::logic_error.
  explicit CSimulator(const Experiment& experiment, const SimulatorOptions& options = {});
  ~CSimulator();
  CSimulator(const CSimulator&) = delete;
  CSimulator& operator=(const CSimulator&) = delete;

  // What the robots' sensors read at the current tick, for who looks at them before their controllers do; else Step
  // begins with it. What the editor changes between the two is sensed one tick later.
  void Sense();
  // Controllers, physics, visualisations: to the next tick. False, and nothing happens, if the experiment is over.
  bool Step();
  // Ends controllers, experiment functions and visualisations; later calls give the same summary.
  const RunSummary& Finish();

  // The state at the current tick, to be read.
  const CSwarmanoidSpace& GetSpace() const;
  // For changes between two steps, with the rules of experiment functions (space_server/experiment_functions.h). They
  // take effect with the next step and are part of the experiment: they change the hash, and a run without the program
  // lacks them.
  SpaceEditor& GetEditor();
  const Experiment& GetExperiment() const;

private:
  struct Roles;
  friend struct WatchedSimulator;
  using Watch = std::function<void(CSimulator&)>;
  // `watch` is called at each tick, before anybody else is shown its state.
  CSimulator(const Experiment& experiment, const SimulatorOptions& options, Watch watch, unsigned hosts = 1);
  // Of a run that others step: to look at it.
  explicit CSimulator(SpaceServer& server);
  void Show();
  // What all roles remember. `canonicalise`: engines are brought to what they save, as at each canonical_period.
  Checkpoint TakeCheckpoint(bool canonicalise);
  // Whether what engines save is all that they remember now.
  bool IsCanonical() const;
  void RefuseWithin(const char* function) const;

  SpaceServer* server_ = nullptr;
  std::unique_ptr<Roles> roles_;  // where this steps them
};

// Reads an experiment file with all built-in plug-ins, `settings` as for --set (path and value). Throws
// ConfigurationError with all mistakes of the file, one a line.
std::unique_ptr<Experiment> ReadExperiment(const std::string& file,
                                           const std::vector<std::pair<std::string, std::string>>& settings = {});

}  // namespace swarmanoid
