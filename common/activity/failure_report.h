// What a process says when it fails: one line on standard error that names the robot, engine, functions or
// visualisation whose code ran, with its step and tick, and the same on the page of whoever started it
// (ActivityPage). It ends with exit code 4 whatever the code did: threw, called exit, _exit or abort, crashed,
// overflowed its stack.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "common/activity/activity.h"

namespace swarmanoid
{

// Somebody's code failed. what() begins with its name, step and tick.
class ActivityError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// From now on this process, called `process` in its reports, tells how it dies. Signals that somebody else handles are
// left alone. Later calls change the name.
void ReportDeaths(const std::string& process);

// Notes why this process is about to end, for whoever started it. The first failure stays. `complete`: the text says by
// itself whom it is about.
void NoteEnd(EndReason reason, std::uint64_t tick, std::string_view text, bool complete = false);

// Ends this process at once, as its own code wants it: no report. Any thread.
[[noreturn]] void LeaveAtOnce(int code);

// The same for what came of somebody's code: reports "<activity> <what>", and ends the process with exit code 4. Safe
// in signal handlers.
[[noreturn]] void DieOf(std::string_view what);

// The same for a step that does not come back, from any thread.
[[noreturn]] void DieOfStep(std::string_view what);

// For a second Ctrl-C: says whose code ran, if any did, and ends the process with exit code 130. Safe in signal
// handlers.
[[noreturn]] void DieInterrupted();

// What the exception that is being handled says, for a user: its text, or its type if it has none.
std::string CurrentExceptionText();

// Writes the whole text to an open file. Safe in signal handlers. False if it cannot.
bool WriteAll(int file, std::string_view text);

// Called when this process dies of somebody's code, or is killed by the user, once that is told: with the line that
// says so, or an empty one, and the exit code. It must be safe in signal handlers. One at a time; nullptr: nobody is
// called.
using LastCall = void (*)(std::string_view line, int exit_code);
void SetLastCall(LastCall call);

// Throws an ActivityError about the activity that just failed by the exception that is being handled. One that says so
// already goes on, and so does the end of a thread.
[[noreturn]] void RethrowFor(const Actor& actor, ActivityStep step, std::uint64_t tick);

// If the step that runs kills this process: how the run could have gone on, to be added to the report. A literal;
// empty: it could not.
void SetCureOfStep(const char* cure);

// Calls somebody's code. What it throws becomes an ActivityError; an exception of type `Through` passes.
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
