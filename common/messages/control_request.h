// What somebody asks of a running experiment. Carried out by the space server's run control between two ticks; the
// fields are explained at ControlRequest in idl/swarmanoid.idl.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmanoid
{

inline const std::vector<std::string> kControlVerbs{"pause", "resume", "step", "speed", "stop",
                                                    "move",  "detach", "add",  "remove"};

// Whether a verb asks for another place of an entity, or for its presence; the name of the entity follows it.
inline bool IsSpaceChange(const std::string& verb)
{
  return verb == "move" || verb == "detach" || verb == "add" || verb == "remove";
}

struct ControlRequestMessage
{
  std::string client;  // "host:pid" of the asker; empty in one process
  std::uint32_t number = 0;
  std::string verb;
  std::string entity;
  std::vector<double> numbers;
  std::string user{};  // name of the user whose process the client is
};

}  // namespace swarmanoid
