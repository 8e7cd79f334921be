// EditedRun: the run of an edited experiment. It runs the text of the editor, saved or not, as `swarmanoid run` does,
// in a process of its own with a page of its own. `swarmanoid edit` has one at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "visualiser/started_run.h"

namespace swarmanoid
{

class EditedRun
{
public:
  enum class Phase
  {
    kNone,
    kStarting,  // its page is not open yet, or the run before it still ends
    kRunning,   // its page is open; the run may have reached its end
    kEnding
  };
  struct Pace
  {
    bool is_paused = false;
    double real_time_factor = 1;  // 0: as fast as possible
  };

  // `folder`: for the file of the experiment that is run.
  explicit EditedRun(std::string folder) : folder_(std::move(folder)) {}

  // Starts a run of an experiment with this name and text. If there is a run, ends it first. Throws
  // std::runtime_error.
  void Start(const std::string& name, const std::string& text, const Pace& pace);
  // Ends the run. It is over when the phase is kNone.
  void End();
  // Looks at the processes. Returns true if something has changed. Call it from time to time.
  bool Look();

  Phase GetPhase() const;
  // Returns the address of the run's page; empty until it is open.
  const std::string& Url() const;
  // Returns why the last run ended by itself; empty if it did not.
  const std::string& Failure() const { return failure_; }

private:
  void StartNext();

  const std::string folder_;
  std::unique_ptr<StartedRun> run_;
  std::string output_;                            // the folder of the run
  std::optional<std::vector<std::string>> next_;  // the options of the run that starts when the present one has ended
  std::string next_name_;
  std::string failure_;
  Phase told_ = Phase::kNone;  // the phase that Look has returned true for
};

}  // namespace swarmanoid
