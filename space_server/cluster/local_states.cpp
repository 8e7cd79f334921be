#include "space_server/cluster/local_states.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/bus/membership/worker_world.h"
#include "common/space/space.h"
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
  {
    // An engine hears of all entities that change their engine, since others may have moved them.
    const EngineLayout& layout = assignment.engines[e];
    std::vector<std::uint32_t> owned;
    std::ranges::set_difference(layout.owned, layout.changing, std::back_inserter(owned));
    Add(PartNameOfEngine(e), e).part = [news = std::make_shared<EngineNews>(space, std::move(owned))](
                                           const SpaceState& state) -> LocalState& { return news->Part(state); };
  }
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
    if (!header.repeated)
    {
      if (listener->is_host && listener->told != nullptr && space_.GetExperiment().ahead > 0)
      {
        listener->before = *listener->told;
        listener->before_header = listener->header;
        listener->before_header.repeated = true;
      }
      listener->told = &listener->part(state);
    }
    listener->told->last = state.last;
    listener->header = header;
    listener->header.source = listener->number;
    if (header.repeated && listener->before) listener->states.Write(listener->before_header, *listener->before);
    listener->states.Write(listener->header, *listener->told);
  }
}

}  // namespace swarmanoid
