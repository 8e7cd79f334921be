// CSimulator: the abstract algorithm of the simulator. It calls all roles of an experiment in this process in turn, one
// tick at a time. It uses no DDS and no copies, and gives the same results as a cluster. It serves `swarmanoid run
// --single-process`, tests, and users' programs that look at every tick or run an experiment many times. One thread
// uses it.
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
#include "common/run/run_options.h"
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
struct RunCompanions;

class CSimulator
{
public:
  // Starts at tick 0 or at the checkpoint of `options`. The experiment must outlive the simulator. Throws
  // ConfigurationError, ActivityError (common/activity/failure_report.h), which names the plug-in that failed, or
  // another std::runtime_error with a text for the user. Sense, Step and Finish throw the same. Code that crashes or
  // calls exit ends the program with such a line and exit code 4. The function that RunSimulation calls at each tick
  // gets a simulator only for reading and editing: its Step and Finish throw std::logic_error.
  explicit CSimulator(const Experiment& experiment, const SimulatorOptions& options = {});
  ~CSimulator();
  CSimulator(const CSimulator&) = delete;
  CSimulator& operator=(const CSimulator&) = delete;

  // Reads the robots' sensors at the current tick, for programs that look at the readings before the controllers do.
  // Otherwise Step does this first. Changes by the editor between Sense and Step are sensed one tick later.
  void Sense();
  // Advances to the next tick: controllers, physics, visualisations. Returns false and does nothing if the experiment
  // is over.
  bool Step();
  // Ends controllers, experiment functions and visualisations, and returns the summary. Later calls return the same
  // one.
  const RunSummary& Finish();

  // Returns the state at the current tick, for reading.
  const CSwarmanoidSpace& GetSpace() const;
  // Returns the editor for changes between two steps, with the rules of experiment functions
  // (space_server/experiment_functions.h). Changes take effect with the next step and are part of the experiment. They
  // change the hash, and a run without the program lacks them.
  SpaceEditor& GetEditor();
  const Experiment& GetExperiment() const;

private:
  struct Roles;
  friend struct WatchedSimulator;
  using Watch = std::function<void(CSimulator&)>;
  // The watch function is called at each tick, before its state is written, drawn or sent.
  CSimulator(const Experiment& experiment, const SimulatorOptions& options, const RunCompanions& companions,
             unsigned hosts = 1);
  // Makes a simulator without roles of its own, to look at a run that others step.
  explicit CSimulator(SpaceServer& server);
  void Show();
  // Returns the state of all roles. `canonicalise`: engines are first brought to the state that they save, as at each
  // canonical_period.
  Checkpoint TakeCheckpoint(bool canonicalise);
  // Returns whether the engines now remember nothing beyond the state that they save.
  bool IsCanonical() const;
  void RefuseWithin(const char* function) const;

  SpaceServer* server_ = nullptr;
  std::unique_ptr<Roles> roles_;  // nullptr if others step the roles
};

// Reads an experiment file with all built-in plug-ins. `settings` are paths and values as for --set. Throws
// ConfigurationError with all mistakes of the file, one in each line.
std::unique_ptr<Experiment> ReadExperiment(const std::string& file,
                                           const std::vector<std::pair<std::string, std::string>>& settings = {});

}  // namespace swarmanoid
