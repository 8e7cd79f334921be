// The file events.csv in the folder of a run: the changes that users made to the run from outside. The run control
// writes it. `swarmanoid run EXPERIMENT --events FILE` reads it to repeat the changes. docs/command.md has the format.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/messages/tick_messages.h"
#include "idl/control_request_message.h"

namespace swarmanoid
{

struct RecordedEvent
{
  std::uint64_t tick = 0;  // the event happens before the state of this tick
  ControlRequestMessage request;
  SourceLocation location;
  bool logged = false;  // this run has logged it already, before its space server died
};

// The verbs of the kinds of lines that are no requests: a message from outside the run was refused, a controller failed
// while the run goes on, and a fault of devices began or ended.
inline constexpr const char* kRefusedMessage = "refused";
inline constexpr const char* kFailedController = "failed";
inline constexpr const char* kDeviceFault = "fault";
// Makes a line that is no request. `about` is the topic, the robot or the fault, `from` the sender or what happened.
ControlRequestMessage NoteOf(const std::string& verb, const std::string& about, const std::string& from);

// Returns the events that change the outcome of a run (move, add, remove, keys and selections, stop), in the order of
// the file. Throws ConfigurationError with file and line if a line is no event of this experiment. An incomplete last
// line, as after the death of a run, is left out with a message on standard error.
std::vector<RecordedEvent> ReadEvents(const std::string& path, const Experiment& experiment);
// Returns the same from the text of the file.
std::vector<RecordedEvent> ParseEvents(const std::string& text, const std::string& path, const Experiment& experiment);

// A line of a log of events, for code that passes it on unchanged.
struct EventLine
{
  std::uint64_t tick = 0;
  std::string text;
};
struct EventLines
{
  std::vector<EventLine> lines;
  // The mistakes of lines that cannot be read, with file and line. An incomplete last line is not in the list.
  std::vector<std::string> damaged;
};
// Returns the lines of a file, or none if it does not exist. Throws ConfigurationError if it cannot be read.
EventLines ReadEventLines(const std::string& path);

// The requests to a run whose space server has died, for the next server.
struct EarlierRequests
{
  std::vector<RecordedEvent> changes;           // the changes that ReadEvents returns
  std::vector<RecordedFault> failed;            // failures of controllers
  std::vector<ControlRequestMessage> answered;  // with a flag: whether the client still waits for a reply
  std::optional<ControlRequestMessage> step;    // a step that has not ended yet
  std::optional<std::uint64_t> pause_at;        // the run is paused, or will be at this tick
  std::optional<double> speed;
  std::vector<ControlOrder> grants;  // orders of the grants that were not revoked
  std::uint64_t until = 0;           // the tick of the newest line
};
// Reads the requests from the log of events, which may be missing. It cuts an incomplete last line off the file.
// `pause_at` is that of the start of the run. Throws ConfigurationError.
EarlierRequests ReadEarlierRequests(const std::string& path, const Experiment& experiment,
                                    std::optional<std::uint64_t> pause_at);
// Appends the events of `repeated` that the run had not executed yet.
void AddUndone(std::vector<RecordedEvent>& done, const std::vector<RecordedEvent>& repeated);
// Returns the sender of a request as "user@host:pid", as far as it is known.
std::string AskerOf(const ControlRequestMessage& request);

class EventLog
{
public:
  // The file is made with the first event. With `goes_on` an existing file is continued. With an empty path nothing is
  // written.
  explicit EventLog(std::string path, bool goes_on = false) : path_(std::move(path)), goes_on_(goes_on) {}
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  // Writes a line with the sender of the request, and the time if it came from another process. Throws
  // std::runtime_error if the file cannot be written.
  void Write(std::uint64_t tick, const ControlRequestMessage& request);

private:
  std::string path_;
  bool goes_on_;
  std::FILE* file_ = nullptr;
};

}  // namespace swarmanoid
