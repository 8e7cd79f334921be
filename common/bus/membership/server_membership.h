// ServerMembership records which processes take part in a run, for the space server. Each has a phase, and one function
// defines how an event changes it. ServerSession reports events to it, and does what it returns. It uses no bus, thread
// or clock. docs/recovery.md prints the table.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "idl/messages.h"

namespace swarmanoid
{

class ServerMembership
{
public:
  enum class Phase : std::uint8_t
  {
    kAwaited,  // no process has come
    kJoined,   // the process builds its part of the world, and matches the others
    kReady,
    kReleased,  // another process is about to replace it; how it ends does not matter
    kDone,      // the process reported the end of its work
    kGone       // the process ended otherwise, for good
  };
  enum class Event : std::uint8_t
  {
    kCame,
    kReplaced,  // another process has come in its place
    kPrepared,  // the process can step
    kReleased,
    kWorkDone,
    kFailed,
    kLost,   // silent, and others replace it
    kMissed  // silent, and nothing replaces it
  };
  enum class Action : std::uint8_t
  {
    kNone,
    kTellLeft,
    kTellLost,
    kFailRun
  };
  static constexpr std::array<std::string_view, 6> kPhases{"Awaited", "Joined", "Ready", "Released", "Done", "Gone"};
  static constexpr std::array<std::string_view, 8> kEvents{"Came",     "Replaced", "Prepared", "Released",
                                                           "WorkDone", "Failed",   "Lost",     "Missed"};
  static constexpr std::array<std::string_view, 4> kActions{"", "tell that it left", "tell that it is lost",
                                                            "fail the run"};

  struct Next
  {
    Phase phase;
    Action action = Action::kNone;
    bool operator==(const Next&) const = default;
  };
  static Next Transition(Phase phase, Event event);

  struct Member
  {
    Phase phase = Phase::kAwaited;
    std::string process{};                   // the newest one; empty if none has come
    std::optional<std::uint64_t> done_at{};  // the tick at which it reported the end of its work
    std::uint32_t incarnation = 0;
    std::string machine{};  // see JoinMessage
    double reach = kReachesAll;
    StatusMessage status{};
    std::set<std::string> replaced{};  // the earlier processes

    bool HasLeft() const { return phase >= Phase::kDone; }
  };

  // The events that the server's main thread has not handled yet.
  struct News
  {
    std::vector<std::string> left;
    std::vector<std::string> lost;
    // The replacements that can step, with their incarnations.
    std::vector<std::pair<std::string, std::uint32_t>> replaced;
    std::vector<LeaveMessage> answers;
  };

  // `expected`: names of the processes that the run waits for.
  ServerMembership(std::uint64_t run, const std::vector<std::string>& expected);

  // A lost process no longer fails the run. A process with a higher incarnation replaces it.
  void AwaitReplacements() { awaits_ = true; }
  // The run is over, so that the end of a process is no failure any more.
  void End() { is_over_ = true; }

  enum class Verdict
  {
    kNothingNew,
    kTaken,
    kNameTaken  // another process has that name
  };
  Verdict Heard(const JoinMessage& join);
  void Heard(const LeaveMessage& leave);
  void Heard(const StatusMessage& status);
  // The process has left the bus, without a Leave if `died`.
  void Missed(const std::string& process, bool died);
  // Returns false if no member has sent the message.
  bool HeardBad(const std::string& process, const std::string& what);
  // Another process is about to replace the one of that name.
  void Release(const std::string& name) { On(name, Event::kReleased); }

  const Member& Of(const std::string& name) const { return members_.at(name); }
  const Member* Find(const std::string& name) const;
  const std::map<std::string, Member>& Members() const { return members_; }
  const std::map<std::string, std::string>& Attached() const { return attached_; }  // name by process
  // Returns the first failure of a process, with its name.
  const std::optional<std::string>& Failure() const { return failure_; }
  News& Latest() { return news_; }

private:
  void On(const std::string& name, Event event, const std::string& failure = {});
  bool MayJoinAs(const Member& member, const JoinMessage& join) const;
  void Answer(const LeaveMessage& answer);

  const std::uint64_t run_;
  bool awaits_ = false;
  bool is_over_ = false;
  std::map<std::string, Member> members_;
  std::map<std::string, std::string> attached_;
  std::optional<std::string> failure_;
  News news_;
};

}  // namespace swarmanoid
