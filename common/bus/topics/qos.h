// Quality of service of every topic, in one table. docs/wire.md shows it to users.
#pragma once

#include <span>
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

inline constexpr TopicQos kTopics[] = {
    // topic            hot    kept   keyed  writer reader
    {"SpaceState", true, false, false, 2, 4},
    {"LocalState", true, false, false, 2, 4},
    {"ControlCommands", true, false, false, 2, 4},  // reader: for each writer
    {"EngineUpdate", true, false, false, 2, 4},     // reader: for each writer
    {"SensorFrame", true, false, false, 2, 4},      // reader: for each writer
    {"Drawn", true, false, false, 2, 4},            // reader: for each writer
    {"RegionTask", true, false, false, 2, 4},
    {"RegionHalo", true, false, false, 2, 4},    // reader: for each writer
    {"RegionResult", true, false, false, 2, 4},  // reader: for each writer
    {"World", false, true, false, 1, 8},
    {"Join", false, true, true, 1, 1},
    {"View", false, true, false, 1, 1},
    {"ControlRequest", false, false, false, 16, 64},
    {"ControlReply", false, false, false, 16, 64},
    {"Status", false, false, false, 4, 64},
    {"SavedState", false, false, false, 64, 64},
    {"RecoveryRequest", false, false, false, 16, 64},
    {"RecoveryBlock", false, false, false, 4, 16},
    {"ViewRequest", false, true, true, 1, 1},
    {"RunStatus", false, true, false, 1, 1},
    {"RobotStatus", false, true, false, 1, 64},
    {"Leave", false, true, false, 16, 64},
};

const TopicQos& QosOf(std::string_view topic);

}  // namespace swarmanoid
