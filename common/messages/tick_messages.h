// The messages between the roles in each tick. They are plain values: the bus carries them between processes, and a run
// in one process passes them by reference. Buffers are reused, so steady running allocates nothing.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "common/messages/drawing.h"

namespace swarmanoid
{

// Attribute slots that changed, ascending by slot, and their new values.
struct AttributeChanges
{
  std::vector<std::uint32_t> slots;
  std::vector<double> values;

  void Clear()
  {
    slots.clear();
    values.clear();
  }
  void Add(std::uint32_t slot, double value)
  {
    slots.push_back(slot);
    values.push_back(value);
  }
};

// Space server to all: the state at a tick, as what changed since the tick before.
struct SpaceState
{
  std::uint64_t tick = 0;
  bool last = false;          // no tick follows
  std::vector<double> poses;  // of the movable entities, structure of arrays: all x (m), y, z, qx, qy, qz, qw
  AttributeChanges attributes;
  std::vector<std::uint32_t> moved;  // entities that were put elsewhere from outside physics, ascending
  Drawing drawing{};                 // of experiment functions, if the run has visualisers
};

// From the space server to one process, in runs over a network: the state with the poses of the movable entities that
// the process needs and that have changed since the last tick.
//
// A controller host gets the entities that its sensors may reach (`near`); for it, all others are outside the arena.
// `attributes` are those of these entities and of all that cannot move. An entity that was not near at the tick before
// has all slots and a pose.
//
// An engine worker gets the entities that it does not move itself, and those that were moved from outside.
struct LocalState : SpaceState
{
  std::vector<std::uint32_t> entities;  // the entities of the poses, ascending
  std::vector<std::uint32_t> near;      // of hosts: bits of the movable entities, in the order of SpaceState::poses
};

inline bool IsNear(const std::vector<std::uint32_t>& near, std::size_t movable)
{
  return (near[movable / 32] >> movable % 32 & 1U) != 0;
}

// From the space server to processes that join late: the whole state at a tick.
struct SpaceSnapshot
{
  std::uint64_t tick = 0;
  bool last = false;
  double real_time_factor = 0;
  std::vector<double> poses;       // as in SpaceState
  std::vector<double> attributes;  // all slots
  Drawing drawing{};               // in views alone
};

// The way in which a controller failed in a run that goes on (OnFailure).
enum class FaultKind : std::uint32_t
{
  kThrew = 1,
  kDied,    // and its process with it; another one took its place
  kTooSlow  // it exceeded its time budget
};
inline const char* FaultText(FaultKind kind)
{
  return kind == FaultKind::kThrew  ? "threw an exception"
         : kind == FaultKind::kDied ? "died"
                                    : "took more processor time than it may";
}
// The faults of a tick.
struct ControllerFaults
{
  // The bytes that the texts of a tick may have, besides the end of each line. Later texts are cut.
  static constexpr std::size_t kMostText = 4096;

  std::vector<std::uint32_t> robots{};  // entities, ascending
  std::vector<FaultKind> kinds{};
  std::vector<char> texts{};  // a line for each: what the exception says. Journals do not keep them

  void Clear()
  {
    robots.clear();
    kinds.clear();
    texts.clear();
  }
  // `text` is one line of UTF-8 that may be shown.
  void Add(std::uint32_t robot, FaultKind kind, std::string_view text)
  {
    const std::size_t used = texts.size() - std::min(texts.size(), robots.size());
    robots.push_back(robot);
    kinds.push_back(kind);
    if (text.size() <= kMostText - std::min(used, kMostText)) texts.insert(texts.end(), text.begin(), text.end());
    texts.push_back('\n');
  }
  // Returns the text of each robot, which may be empty.
  std::vector<std::string> Texts() const
  {
    std::vector<std::string> lines(robots.size());
    std::size_t k = 0;
    for (const char c : texts)
      if (c == '\n')
        ++k;
      else if (k < lines.size())
        lines[k] += c;
    return lines;
  }
  // Texts are for people: they make no difference.
  bool operator==(const ControllerFaults& other) const { return robots == other.robots && kinds == other.kinds; }
};
// A fault of a tick that was computed before. When the tick is repeated, the same controllers fail, and no time is
// measured.
struct RecordedFault
{
  std::uint64_t tick = 0;
  std::uint32_t robot = 0;
  FaultKind kind = FaultKind::kThrew;
  std::string text{};  // what the exception says, if it is known. It is for people, and makes no difference

  auto operator<=>(const RecordedFault& other) const
  {
    return std::tie(tick, robot, kind) <=> std::tie(other.tick, other.robot, other.kind);
  }
  bool operator==(const RecordedFault& other) const { return std::is_eq(*this <=> other); }
};
struct RecordedFaults
{
  std::uint64_t until = 0;  // all ticks before were done
  std::vector<RecordedFault> faults;

  void Add(const RecordedFaults& others)
  {
    until = std::max(until, others.until);
    faults.insert(faults.end(), others.faults.begin(), others.faults.end());
  }
};

// From a controller host to engines and server: the commands of the host's robots in the tick that starts at `tick`.
struct ControlCommands
{
  std::uint64_t tick = 0;
  std::uint32_t host = 0;
  std::vector<double> values;   // of the specific actuators, laid out as HostLayout::commands says
  AttributeChanges attributes;  // set by generic actuators
  ControllerFaults faults{};
};

// Engine worker to server: the outcome of the step that leads to `tick`.
struct EngineUpdate
{
  std::uint64_t tick = 0;
  std::uint32_t engine = 0;
  std::vector<double> poses;  // of the entities that the engine owns, structure of arrays as in SpaceState
  AttributeChanges attributes;
};

// Engine worker to hosts: values of the specific sensors at `tick`, laid out as EngineLayout::sensors says.
struct SensorFrame
{
  std::uint64_t tick = 0;
  std::uint32_t engine = 0;
  std::vector<double> values;
};

}  // namespace swarmanoid
