// The messages between the roles in each tick. They are plain values: the bus carries them between processes, and a run
// in one process passes them by reference. Buffers are reused, so steady running allocates nothing. The structs come
// from idl/swarmanoid.idl.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "idl/control_commands.h"
#include "idl/engine_update.h"
#include "idl/local_state.h"
#include "idl/recorded_faults.h"
#include "idl/sensor_frame.h"
#include "idl/space_snapshot.h"

namespace swarmanoid
{

inline bool IsNear(const std::vector<std::uint32_t>& near, std::size_t movable)
{
  return (near[movable / 32] >> movable % 32 & 1U) != 0;
}

inline const char* FaultText(FaultKind kind)
{
  return kind == FaultKind::kThrew  ? "threw an exception"
         : kind == FaultKind::kDied ? "died"
                                    : "took more processor time than it may";
}

// The bytes that the texts of a tick's faults may have, besides the end of each line. Later texts are cut.
inline constexpr std::size_t kMostFaultText = 4096;

inline void Clear(ControllerFaults& faults)
{
  faults.robots.clear();
  faults.kinds.clear();
  faults.texts.clear();
}

// `text` is one line of UTF-8 that may be shown.
inline void Add(ControllerFaults& faults, std::uint32_t robot, FaultKind kind, std::string_view text)
{
  std::vector<char>& texts = faults.texts;
  const std::size_t used = texts.size() - std::min(texts.size(), faults.robots.size());
  faults.robots.push_back(robot);
  faults.kinds.push_back(kind);
  if (text.size() <= kMostFaultText - std::min(used, kMostFaultText))
    texts.insert(texts.end(), text.begin(), text.end());
  texts.push_back('\n');
}

// Returns the text of each robot, which may be empty.
inline std::vector<std::string> TextsOf(const ControllerFaults& faults)
{
  std::vector<std::string> lines(faults.robots.size());
  std::size_t k = 0;
  for (const char c : faults.texts)
    if (c == '\n')
      ++k;
    else if (k < lines.size())
      lines[k] += c;
  return lines;
}

// Texts of faults are for people: they make no difference.
inline bool operator==(const ControllerFaults& a, const ControllerFaults& b)
{
  return a.robots == b.robots && a.kinds == b.kinds;
}
inline auto operator<=>(const RecordedFault& a, const RecordedFault& b)
{
  return std::tie(a.tick, a.robot, a.kind) <=> std::tie(b.tick, b.robot, b.kind);
}
inline bool operator==(const RecordedFault& a, const RecordedFault& b) { return std::is_eq(a <=> b); }

inline void Add(RecordedFaults& faults, const RecordedFaults& others)
{
  faults.until = std::max(faults.until, others.until);
  faults.faults.insert(faults.faults.end(), others.faults.begin(), others.faults.end());
}

}  // namespace swarmanoid
