// LocalStates: the parts of the state that the space server sends to single processes over a network, instead of the
// whole state. Engines get parts, and so do controller hosts that have reported their reach. Lockstep uses it, with its
// mutex locked.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/membership/server_session.h"
#include "common/bus/membership/tick_limits.h"

namespace swarmanoid
{

class LocalStates
{
public:
  // All arguments must outlive the object.
  LocalStates(ServerSession& session, const CSwarmanoidSpace& space, const Assignment& assignment,
              const TickLimits& limits);

  bool IsEmpty() const { return listeners_.empty(); }
  unsigned Readers() const;
  // Sends the state of the space's tick. If the header says that it is repeated, the last message is sent again, and
  // before it the one of the tick before to hosts whose commands act a tick later.
  void Write(const MessageHeader& header, const SpaceState& state);

private:
  struct Listener
  {
    Listener(Bus& bus, const HotScope& scope, std::uint32_t of) : states(bus, scope), number(of) {}

    HotPublisher<LocalState> states;
    std::uint32_t number;  // number of the host or engine
    bool is_host = false;
    std::function<LocalState&(const SpaceState&)> part{};  // none: the host gets the state of all entities
    LocalState* told = nullptr;                            // the message of the tick
    MessageHeader header{};                                // the header of `told`
    std::optional<LocalState> before{};                    // the message of the tick before, if a host may lack it
    MessageHeader before_header{};
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
