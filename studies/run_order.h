// One run of a study, as it is told to a process that runs it, and what came of it.
#pragma once

#include <cstdint>
#include <string>

#include "common/serialisation/bytes.h"
#include "studies/design.h"
#include "studies/recorder.h"

namespace swarmanoid
{

struct RunOrder
{
  RunName name;
  std::string experiment;  // file
  StudySettings settings;  // without the seed

  void Write(ByteWriter& bytes) const;
  static RunOrder Read(ByteReader& bytes);
};

struct RunOutcome
{
  RunName name;
  int exit_code = 0;  // as `swarmanoid run` has it; 128 + signal of a process that was killed
  std::string failure;
  std::uint64_t ticks = 0;
  std::uint64_t hash = 0;
  double wall_s = 0;  // with reading the experiment
  std::uint64_t peak_bytes = 0;
  RunSamples samples;
  std::string host;  // that ran it; empty: this machine

  // Whether it has a result: it ended by itself, with success or by the experiment's own measure without.
  bool IsDone() const { return exit_code == 0 || exit_code == 1; }
  void Write(ByteWriter& bytes) const;
  static RunOutcome Read(ByteReader& bytes);
};

// Runs it in a process of its own, which is a copy of this one and so has all plug-ins that this one has loaded. The
// folder of the run is `<study_folder>/runs/<name>`; if the run leaves nothing there, and has a result, it is removed.
// For a process with one thread.
RunOutcome RunInCopy(const Study& study, const std::string& study_folder, const RunOrder& order);

}  // namespace swarmanoid
