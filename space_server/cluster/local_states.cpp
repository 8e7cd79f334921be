#include "space_server/cluster/local_states.h"

#include <utility>

#include "common/bus/membership/worker_world.h"
#include "space_server/near_entities.h"

namespace swarmanoid
{

LocalStates::LocalStates(ServerSession& session, const CSwarmanoidSpace& space, const Assignment& assignment,
                         const TickLimits& limits)
    : session_(session), space_(space), assignment_(assignment), limits_(limits)
{
  for (std::size_t h = 0; HostsAskForParts(session.World()) && h < assignment.hosts.size(); ++h)
    Add(HostName(h), h).is_host = true;
  for (std::size_t e = 0; EnginesHearParts(session.World()) && e < assignment.engines.size(); ++e)
    Add(PartNameOfEngine(e), e).part = [news = std::make_shared<EngineNews>(space, assignment.engines[e].owned)](
                                           const SpaceState& state) -> LocalState& { return news->Part(state); };
}

LocalStates::Listener& LocalStates::Add(const std::string& name, std::size_t number)
{
  HotScope scope = session_.Scope(limits_.LocalStateBytes(), 1);
  scope.listener = name;
  listeners_.push_back(std::make_unique<Listener>(session_.GetBus(), scope, static_cast<std::uint32_t>(number)));
  return *listeners_.back();
}

unsigned LocalStates::Readers() const
{
  unsigned readers = 0;
  for (const auto& listener : listeners_) readers += listener->states.Readers();
  return readers;
}

// Every subscribed host has reported its reach before the first state. So has every process that replaces one.
void LocalStates::FindReaches()
{
  if (std::exchange(reaches_are_known_, true)) return;
  for (const auto& listener : listeners_)
    if (listener->is_host && listener->states.Readers() > 0)
      listener->part = [surroundings = std::make_shared<Surroundings>(
                            space_, assignment_.hosts[listener->number].robots,
                            session_.ReachOf(HostName(listener->number)))](const SpaceState& state) -> LocalState&
      { return surroundings->Part(state); };
}

void LocalStates::Write(const MessageHeader& header, const SpaceState& state)
{
  FindReaches();
  for (const auto& listener : listeners_)
  {
    if (!listener->part) continue;
    if (!header.repeated) listener->told = &listener->part(state);
    listener->told->last = state.last;
    MessageHeader own = header;
    own.source = listener->number;
    listener->states.Write(own, *listener->told);
  }
}

}  // namespace swarmanoid
