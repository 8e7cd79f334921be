// A process that executes runs of a study for another process. On another machine it communicates through its standard
// input and output. As a task of Slurm it uses files in the study's folder. Users do not start it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swarmanoid
{

inline constexpr const char* kStudyWorkerFlag = "--study-worker";

// Executes runs for another process. `words` is empty, or has the folder of the jobs and the number of the task.
// Returns the exit code. The command finds it by its name, when it has loaded the library of studies.
extern "C" int RunStudyWorker(const std::vector<std::string>& words);

// The first byte of a message through the pipes.
enum class StudyMessage : std::uint8_t
{
  kSetup,      // to the worker: seconds of the lease (u32), runs at a time (u32; 0: one for each core), the setup
  kOrder,      // to the worker: a RunOrder
  kStillHere,  // both ways: the sender is alive
  kReady,      // from the worker: runs at a time (u32)
  kRefused,    // from the worker: the reason
  kOutcome     // from the worker: a RunOutcome, RunFiles
};

// Returns a message in the form for a pipe.
std::vector<char> FramedMessage(StudyMessage kind, std::span<const char> content);

}  // namespace swarmanoid
