// DiscoveryPace leaves out datagrams of discovery that say to a process what it was told shortly before.
//
// Fast DDS announces a process to all that it knows whenever it finds another one. When it tells the new one its
// writers and readers, it asks all others, too, whether they know them (by a heartbeat). Where N processes start
// together, each would be told everything N times. Fast DDS repeats both, so one that is lost comes again.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

namespace swarmanoid
{

class DiscoveryPace
{
public:
  using Clock = std::chrono::steady_clock;
  // Less than the time after which heartbeats are repeated on one machine.
  static constexpr auto kPause = std::chrono::milliseconds(150);
  // So often the same is said without a pause. The other process may not be ready for it, and small runs begin sooner.
  static constexpr unsigned kFirst = 4;
  // A socket, and an address with its port.
  using Way = std::pair<const void*, std::uint64_t>;

  // Returns what a datagram says, if it may be left out: an announcement of a process, or a heartbeat of a writer to
  // all of its readers. Otherwise returns an empty text. `datagram`: as Fast DDS made it. `spreads`: datagrams may be
  // lost on a network, and heartbeats of writers that are not built-in find that within milliseconds. They all go.
  static std::string WhatMayBeLeftOut(std::span<const char> datagram, bool spreads);

  // Takes what goes a way now. Returns whether the same went it kFirst times, and less than kPause before.
  bool IsEarly(const std::string& what, const Way& way, Clock::time_point now);

private:
  struct Said
  {
    Clock::time_point last;
    unsigned times = 0;
  };
  std::unordered_map<std::string, Said> said_;  // by what was said, and the way
  std::size_t most_ = 1024;                     // the number of these at which old ones are removed
};

}  // namespace swarmanoid
