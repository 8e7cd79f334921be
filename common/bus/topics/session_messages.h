// The messages between the processes of a run, except the messages of a tick (common/messages/tick_messages.h). The
// plain side of idl/swarmanoid.idl, where each field is explained.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/messages/assignment.h"
#include "common/messages/control_request.h"
#include "common/messages/robot_status.h"
#include "common/messages/run_status.h"
#include "common/messages/tick_messages.h"

namespace swarmanoid
{

// Equal to PROTOCOL_VERSION of the IDL; a test says so.
inline constexpr std::uint32_t kProtocolVersion = 20;

// Precedes every message of a tick.
struct MessageHeader
{
  std::uint64_t run = 0;
  std::uint64_t tick = 0;
  std::uint32_t source = 0;
  bool repeated = false;
  std::uint32_t incarnation = 0;  // of the sender; messages of a replaced process are dropped
  bool save = false;              // SpaceState: roles with memory save their state after the step to the next tick
};

// An engine worker sends it to the server.
struct UpdateMessage : EngineUpdate
{
  // For the journal, if the run keeps one: the commands that the step took, laid out as EngineLayout::commands says.
  // The values of the SensorFrame of the same tick follow.
  std::vector<double> recorded;
};

// A visualiser of the experiment tells the server that it has drawn the state of the header's tick.
struct DrawnMessage
{
  bool terminate = false;
};

// The messages between a split engine's worker and its region processes, and among the region processes.
struct RegionMessage
{
  std::uint32_t epoch = 0;
  std::uint32_t number = 0;
  std::vector<std::uint32_t> sizes;  // of the parts
  std::vector<char> bytes;           // of all parts, one behind the other
};
struct RegionTaskMessage : RegionMessage
{
};
struct RegionHaloMessage : RegionMessage
{
};
struct RegionResultMessage : RegionMessage
{
};

struct WorldEntity
{
  std::string id;
  std::string kind;
  bool movable = false;
  std::uint32_t first_slot = 0;
};

// A library that the processes of the run may load.
struct WorldLibrary
{
  std::string name;
  std::string digest;  // SHA-256 of the file, 64 hexadecimal digits
};

struct WorldMessage
{
  std::uint32_t protocol = kProtocolVersion;
  std::uint64_t run = 0;
  std::string experiment;
  std::string host;
  std::uint32_t pid = 0;
  std::string file;
  std::string folder;
  std::string xml;
  std::uint64_t seed = 0;
  HostTable hosts{};
  bool spread = false;
  double tick_seconds = 0;
  std::uint64_t checkpoint_every = 0;
  std::vector<char> checkpoint;
  bool recorded = false;
  std::vector<WorldEntity> entities;
  std::vector<WorldLibrary> libraries{};
  RecordedFaults known{};
};

// JoinMessage::reach of processes that receive the state of all.
inline constexpr double kReachesAll = -1;

struct JoinMessage
{
  std::string process;
  std::uint32_t protocol = kProtocolVersion;
  std::uint64_t run = 0;
  std::string name;
  bool ready = false;
  std::uint32_t incarnation = 0;
  std::string machine{};
  double reach = kReachesAll;  // m
};

struct ViewMessage
{
  std::uint64_t run = 0;
  SpaceSnapshot snapshot;
};

struct ControlReplyMessage
{
  std::string client;
  std::uint32_t number = 0;
  bool ok = false;
  std::uint64_t tick = 0;
  std::string text;
};

struct StatusMessage
{
  std::uint64_t run = 0;
  std::uint64_t tick = 0;
  std::string name;
  std::string text;
};

struct SavedStateMessage
{
  std::uint64_t run = 0;
  std::uint64_t tick = 0;
  std::string name;
  std::vector<char> state;
};

struct RecoveryRequestMessage
{
  std::uint64_t run = 0;
  std::string process;
  std::string name;
  std::uint32_t number = 0;
};

struct RecoveryBlockMessage
{
  std::uint64_t run = 0;
  std::string process;
  std::uint32_t number = 0;
  std::uint32_t count = 0;
  std::vector<char> block;
};

struct ViewRequestMessage
{
  std::string client;
  std::uint64_t run = 0;
  double views = 0;
  bool every_tick = false;
  std::vector<std::uint32_t> robots;
};

struct RunStatusMessage
{
  std::uint64_t run = 0;
  RunStatus status;
};

struct RobotStatusMessage
{
  std::uint64_t run = 0;
  std::uint64_t tick = 0;
  std::uint32_t source = 0;
  std::vector<RobotStatus> robots;
};

struct LeaveMessage
{
  std::uint64_t run = 0;
  std::uint64_t tick = 0;
  std::string name;
  std::string process;
  std::string error;
};

}  // namespace swarmanoid
