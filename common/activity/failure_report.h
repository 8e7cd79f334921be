// The report of a process that fails: one line on standard error that names the robot, engine, functions or
// visualisation whose code ran, with its step and tick. The page of the process that started it gets the same report
// (ActivityPage). The exit code is 4, whether the code threw, called exit, _exit or abort, crashed, or overflowed its
// stack.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "common/activity/activity.h"

namespace swarmanoid
{

// It is thrown if the code of a plug-in failed. what() begins with the name, the step and the tick of the code.
class ActivityError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// Makes this process, called `process` in its reports, report how it dies. Signals that already have a handler are left
// alone. Later calls change the name.
void ReportDeaths(const std::string& process);

// Notes why this process is about to end, for the process that started it. The first failure stays. `complete`: the
// text already names the actor.
void NoteEnd(EndReason reason, std::uint64_t tick, std::string_view text, bool complete = false);

// Ends this process at once without a report. Any thread may call it.
[[noreturn]] void LeaveAtOnce(int code);

// Reports "<activity> <what>" because a plug-in's code failed, and ends the process with exit code 4. Safe in signal
// handlers.
[[noreturn]] void DieOf(std::string_view what);

// Reports a step that does not return, from any thread, and ends the process as DieOf does.
[[noreturn]] void DieOfStep(std::string_view what);

// Handles a second Ctrl-C: reports which plug-in's code ran, if any did, and ends the process with exit code 130. Safe
// in signal handlers.
[[noreturn]] void DieInterrupted();

// Returns the text of the exception that is being handled, or its type if it has no text.
std::string CurrentExceptionText();

// Writes the whole text to an open file. Safe in signal handlers. Returns false if writing fails.
bool WriteAll(int file, std::string_view text);

// A function that is called after the report, when a plug-in's code or the user ends this process. It gets the line of
// the report, which may be empty, and the exit code. It must be safe in signal handlers. One function is set at a time;
// nullptr: none.
using LastCall = void (*)(std::string_view line, int exit_code);
void SetLastCall(LastCall call);

// Turns the exception that is being handled into an ActivityError about this activity and throws it. An ActivityError
// and the end of a thread pass unchanged.
[[noreturn]] void RethrowFor(const Actor& actor, ActivityStep step, std::uint64_t tick);

// Sets the advice that is added to the report if the current step ends the process: how the run could continue. A
// literal; empty: no advice.
void SetCureOfStep(const char* cure);

// Calls a plug-in's code. Its exceptions become an ActivityError; an exception of type `Through` passes.
template <class Through = ActivityError, class Call>
void RunCodeOf(const Actor& actor, ActivityStep step, std::uint64_t tick, Call&& call)
{
  const Activity activity(actor, step, tick);
  try
  {
    call();
  }
  catch (const Through&)
  {
    throw;
  }
  catch (...)
  {
    RethrowFor(actor, step, tick);
  }
}

}  // namespace swarmanoid
