// What somebody asks of a running experiment. Carried out by the space server's run control between two ticks; the
// fields are explained at ControlRequest in idl/swarmanoid.idl.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmanoid
{

inline const std::vector<std::string> kControlVerbs{
    "pause",     "resume",      "step",  "speed", "stop",     "reset", "move",    "detach", "add",     "remove",
    "move-host", "move-engine", "drain", "hosts", "machines", "press", "release", "select", "deselect"};

// Only members of the run may ask for these: grants of the run (common/bus/security/grant.h).
inline const std::vector<std::string> kGrantVerbs{"share", "shares", "revoke"};

// Whether a verb asks for another place of an entity, or for its presence; the name of the entity follows it.
inline bool IsSpaceChange(const std::string& verb)
{
  return verb == "move" || verb == "detach" || verb == "add" || verb == "remove";
}

// Whether a verb is for experiment functions: of keys, whose name stands in the place of the entity, and of who is
// selected.
inline bool IsInput(const std::string& verb)
{
  return verb == "press" || verb == "release" || verb == "select" || verb == "deselect";
}

// Whether a verb asks for another place of workers. In the place of the entity: the number or id of the worker, and
// " to " with a machine unless it stays on its own; for drain a machine. For hosts likewise, or nothing; its number
// says how many controller hosts more there are to be, or fewer.
inline bool IsWorkerMove(const std::string& verb)
{
  return verb == "move-host" || verb == "move-engine" || verb == "drain" || verb == "hosts";
}

// The answer to who asked of a run what it did not come to any more.
inline std::string RunEndedText(std::uint64_t tick) { return "the run ended at tick " + std::to_string(tick); }

struct ControlRequestMessage
{
  std::string client;  // "host:pid" of the asker; empty in one process
  std::uint32_t number = 0;
  std::string verb;
  std::string entity;
  std::vector<double> numbers;
  std::string user{};     // name of the user whose process the client is
  std::uint64_t run = 0;  // that is meant: what was asked of another one is not repeated in this one
};

}  // namespace swarmanoid
