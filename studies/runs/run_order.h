// The order for one run of a study, and its outcome.
#pragma once

#include <cstdint>
#include <string>

#include "common/serialisation/fields.h"
#include "studies/design/design.h"
#include "studies/metrics/recorder.h"

namespace swarmanoid
{

struct RunOrder
{
  RunName name;
  std::string experiment;  // file
  StudySettings settings;  // without the seed

  template <class Archive, class Order>
  static void Visit(Archive& archive, Order& order)
  {
    archive.Number(order.name.point);
    archive.Number(order.name.seed);
    archive.Text(order.experiment);
    archive.List(order.settings,
                 [&](auto& setting)
                 {
                   archive.Text(setting.first);
                   archive.Text(setting.second);
                 });
  }
};

struct RunOutcome
{
  RunName name;
  int exit_code = 0;  // exit code of `swarmanoid run`; 128 + signal for a killed process
  std::string failure;
  std::uint64_t ticks = 0;
  std::uint64_t hash = 0;
  double wall_s = 0;  // including the time to read the experiment
  std::uint64_t peak_bytes = 0;
  RunSamples samples;
  std::string host;  // the machine that ran it; empty: this one

  // Returns whether it has a result: it ended by itself, with success or with a failure by the experiment's own
  // condition.
  bool IsDone() const { return exit_code == 0 || exit_code == 1; }

  template <class Archive, class Outcome>
  static void Visit(Archive& archive, Outcome& outcome)
  {
    archive.Number(outcome.name.point);
    archive.Number(outcome.name.seed);
    archive.Number(outcome.exit_code);
    archive.Text(outcome.failure);
    archive.Number(outcome.ticks);
    archive.Number(outcome.hash);
    archive.Number(outcome.wall_s);
    archive.Number(outcome.peak_bytes);
    RunSamples::Visit(archive, outcome.samples);
    archive.Text(outcome.host);
  }
};

// Executes the run in a separate process, a copy of this one that has all loaded plug-ins. The folder of the run is
// `<study_folder>/runs/<name>`. It is removed if the run leaves no files and has a result. The calling process must
// have one thread.
RunOutcome RunInCopy(const Study& study, const std::string& study_folder, const RunOrder& order);

}  // namespace swarmanoid
