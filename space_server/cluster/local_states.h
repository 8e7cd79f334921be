// LocalStates: the parts of the state that the space server sends to single processes over a network, instead of the
// whole state. Engines get parts, and so do controller hosts that have reported their reach. Used by Lockstep, with its
// mutex locked.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"
#include "common/bus/membership/tick_limits.h"

namespace swarmanoid
{

class LocalStates
{
public:
  // All outlive it.
  LocalStates(ServerSession& session, const CSwarmanoidSpace& space, const Assignment& assignment,
              const TickLimits& limits);

  bool IsEmpty() const { return listeners_.empty(); }
  unsigned Readers() const;
  // Sends the state of the space's tick. If the header says that it is repeated, the last message is sent again.
  void Write(const MessageHeader& header, const SpaceState& state);

private:
  struct Listener
  {
    Listener(Bus& bus, const HotScope& scope, std::uint32_t of) : states(bus, scope), number(of) {}

    HotPublisher<LocalState> states;
    std::uint32_t number;  // of the host or engine
    bool is_host = false;
    std::function<LocalState&(const SpaceState&)> part{};  // none: a host that hears the state of all
    LocalState* told = nullptr;                            // of the tick
  };

  Listener& Add(const std::string& name, std::size_t number);
  void FindReaches();

  ServerSession& session_;
  const CSwarmanoidSpace& space_;
  const Assignment& assignment_;
  const TickLimits& limits_;
  std::vector<std::unique_ptr<Listener>> listeners_;
  bool reaches_are_known_ = false;
};

}  // namespace swarmanoid
