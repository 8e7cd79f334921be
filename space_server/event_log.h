// What users changed in a run from outside, as a file: events.csv in the folder of the run. Written by the control
// control; read to repeat the changes in another run (`swarmanoid run EXPERIMENT --events FILE`). docs/command.md has
// the format.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/messages/control_request.h"
#include "common/messages/tick_messages.h"

namespace swarmanoid
{

struct RecordedEvent
{
  std::uint64_t tick = 0;  // before whose state it is done
  ControlRequestMessage request;
  SourceLocation location;
  bool logged = false;  // by this run already, before its space server died
};

// The verbs of two kinds of lines that are no requests: a message from outside the run was refused, and a controller
// failed while the run goes on.
inline constexpr const char* kRefusedMessage = "refused";
inline constexpr const char* kFailedController = "failed";
// Makes a line that is no request. `about` is the topic or the robot, `from` the sender or what the controller did.
ControlRequestMessage NoteOf(const std::string& verb, const std::string& about, const std::string& from);

// The events that change the outcome of a run (move, add, remove, keys and selections, stop), in the order of the file.
// Throws ConfigurationError, with file and line, for what is no event of this experiment. If the last line was cut
// short, as by the death of the run, it is left out, and standard error says so.
std::vector<RecordedEvent> ReadEvents(const std::string& path, const Experiment& experiment);
// The same from the text of the file.
std::vector<RecordedEvent> ParseEvents(const std::string& text, const std::string& path, const Experiment& experiment);

// A line of a log of events, for what passes it on as it is.
struct EventLine
{
  std::uint64_t tick = 0;
  std::string text;
};
struct EventLines
{
  std::vector<EventLine> lines;
  // What cannot be read, with file and line. A last line that was cut short is not among it.
  std::vector<std::string> damaged;
};
// Those of a file; none if it does not exist. Throws ConfigurationError if it cannot be read.
EventLines ReadEventLines(const std::string& path);

// What was asked of a run whose space server has died, for the next one.
struct EarlierRequests
{
  std::vector<RecordedEvent> changes;           // as ReadEvents has them
  std::vector<RecordedFault> failed;            // of controllers
  std::vector<ControlRequestMessage> answered;  // and whether its asker had an answer coming
  std::optional<ControlRequestMessage> step;    // one that is not done yet
  std::optional<std::uint64_t> pause_at;        // the run is paused, or will be at this tick
  std::optional<double> speed;
  std::vector<ControlOrder> grants;  // the orders that made those that were not revoked
  std::uint64_t until = 0;           // the tick of the newest
};
// From its log of events, which may be lacking; the half of a line at its end is cut off. `pause_at`: of its start.
// Throws ConfigurationError.
EarlierRequests ReadEarlierRequests(const std::string& path, const Experiment& experiment,
                                    std::optional<std::uint64_t> pause_at);
// Those of `repeated` that the run had not done yet, after those that it had.
void AddUndone(std::vector<RecordedEvent>& done, const std::vector<RecordedEvent>& repeated);
// "user@host:pid" of who asked, as far as it is known.
std::string AskerOf(const ControlRequestMessage& request);

class EventLog
{
public:
  // The file is made with the first event, unless there is one that `goes_on`. Empty path: nothing is written.
  explicit EventLog(std::string path, bool goes_on = false) : path_(std::move(path)), goes_on_(goes_on) {}
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  // With who asked, and when if it came from outside of this process. Throws std::runtime_error if the file cannot be
  // written.
  void Write(std::uint64_t tick, const ControlRequestMessage& request);

private:
  std::string path_;
  bool goes_on_;
  std::FILE* file_ = nullptr;
};

}  // namespace swarmanoid
