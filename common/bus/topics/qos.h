// Quality of service of every topic. idl/swarmanoid.idl states it, and docs/wire.md shows it to users.
#pragma once

#include <string_view>

namespace swarmanoid
{

struct TopicQos
{
  std::string_view topic;
  // Messages of a tick: data sharing, and best-effort readers if the run stays on one machine (no acknowledgements:
  // half the time of a tick). Lost messages are asked for again by the lock-step protocol.
  bool hot = false;
  bool transient_local = false;  // kept for processes that join later
  bool keyed = false;
  int writer_depth = 1;  // KEEP_LAST: a reader that does not read never blocks a writer
  int reader_depth = 1;
};

const TopicQos& QosOf(std::string_view topic);

}  // namespace swarmanoid
