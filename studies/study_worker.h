// A process that runs runs of a study for another one: on another machine, where it hears and answers through its
// standard input and output, or as a task of Slurm, with files in the study's folder. Not for users.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swarmanoid
{

inline constexpr const char* kStudyWorkerFlag = "--study-worker";

// `words`: nothing, or the folder of the jobs and the number of the task. Returns the exit code.
int RunStudyWorker(const std::vector<std::string>& words);

// First byte of what is told through pipes.
enum class StudyMessage : std::uint8_t
{
  kSetup,      // to the worker: seconds of the lease (u32), runs at a time (u32; 0: as many as cores), the setup
  kOrder,      // to the worker: a RunOrder
  kStillHere,  // both ways, so that the other one is known to be there
  kReady,      // from the worker: runs at a time (u32)
  kRefused,    // from the worker: why
  kOutcome     // from the worker: a RunOutcome, RunFiles
};

// A message as it goes through a pipe.
std::vector<char> FramedMessage(StudyMessage kind, std::span<const char> content);

}  // namespace swarmanoid
