// Any payload of any topic is refused with the name of a field, or is a message whose own bytes give it again. The
// first byte of an input chooses the topic.
#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "common/bus/topics/message_bytes.h"
#include "tests/fuzz/fuzz_driver.h"

namespace swarmanoid
{
namespace
{

template <class... Parts>
std::string BytesOf(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '\0');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

// Not byte for byte: padding may hold anything, and an empty text may come without its zero.
template <class Message>
void TryOther(std::span<const char> payload)
{
  Message message;
  ReadPayload(payload, message);
  if constexpr (requires { message.protocol; })
    if (message.protocol != kProtocolVersion) return;
  const std::string bytes = BytesOf(message);
  Message again;
  ReadPayload(bytes, again);
  if (BytesOf(again) != bytes) std::abort();
}

template <class Message>
void TryOfTick(std::span<const char> payload)
{
  const auto read = [](std::span<const char> from, MessageHeader& header, Message& message)
  {
    ReadTickPayload<Message>(
        from, header, [&](const MessageHeader&) { return &message; }, [](const MessageHeader&, const Message&) {});
  };
  MessageHeader header;
  Message message;
  read(payload, header, message);
  const std::string bytes = BytesOf(header, message);
  MessageHeader header_again;
  Message again;
  read(bytes, header_again, again);
  if (BytesOf(header_again, again) != bytes || bytes.size() > payload.size()) std::abort();
}

constexpr void (*kTries[])(std::span<const char>) = {TryOfTick<SpaceState>,
                                                     TryOfTick<ControlCommands>,
                                                     TryOfTick<UpdateMessage>,
                                                     TryOfTick<SensorFrame>,
                                                     TryOfTick<DrawnMessage>,
                                                     TryOther<WorldMessage>,
                                                     TryOther<JoinMessage>,
                                                     TryOther<ViewMessage>,
                                                     TryOther<ControlRequestMessage>,
                                                     TryOther<ControlReplyMessage>,
                                                     TryOther<StatusMessage>,
                                                     TryOther<SavedStateMessage>,
                                                     TryOther<ViewRequestMessage>,
                                                     TryOther<RunStatusMessage>,
                                                     TryOther<RobotStatusMessage>,
                                                     TryOther<LeaveMessage>,
                                                     TryOther<RecoveryRequestMessage>,
                                                     TryOther<RecoveryBlockMessage>,
                                                     TryOfTick<RegionTaskMessage>,
                                                     TryOfTick<RegionHaloMessage>,
                                                     TryOfTick<RegionResultMessage>,
                                                     TryOfTick<LocalState>};

fuzz::Input InputOf(std::uint8_t topic, const std::string& payload)
{
  fuzz::Input input(payload.size() + 1, topic);
  std::copy(payload.begin(), payload.end(), input.begin() + 1);
  return input;
}

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  const MessageHeader header{0x1122334455667788ULL, 7, 0, true};
  AttributeChanges changes;
  changes.Add(3, 0.5);
  changes.Add(77, 16711680);
  SpaceState state;
  state.poses = {1, 2, 3, 0, 0, 0, 1};
  state.attributes = changes;
  state.moved = {4, 9};
  LocalState local;
  local.poses = state.poses;
  local.attributes = changes;
  local.entities = {4};
  local.near = {16};
  ControlCommands commands;
  commands.values = {0.1, -0.1};
  commands.attributes = changes;
  commands.faults = {{4, 9}, {FaultKind::kThrew, FaultKind::kDied}};
  UpdateMessage update;
  update.poses = state.poses;
  update.attributes = changes;
  update.recorded = {0.1, -0.1, 0.25};
  SensorFrame frame;
  frame.values = {0.25};
  ViewMessage view{5, {7, true, 1.5, state.poses, {1, 2, 3}}};
  RunStatusMessage status;
  status.status.phase = RunStatus::Phase::kRunning;
  status.status.processes = {{"space server", "host:1", 7, 0.5, "runs its engine"}};
  RobotStatusMessage robots{5, 7, 0, {{3, 7, "c", "text", "state", {{"footbot_proximity", {{"0", "m", 0.5}}}}, {}}}};
  const WorldMessage world{kProtocolVersion,
                           5,
                           "e",
                           "host",
                           2,
                           "e.xml",
                           "/x",
                           "<x/>",
                           3,
                           HostTable{2, std::vector<std::uint32_t>(2)},
                           false,
                           0.1,
                           100,
                           {'a', 'b'},
                           false,
                           {{"fb", "footbot", true, 0}},
                           {},
                           {12, {{7, 0, FaultKind::kTooSlow}}}};
  return {InputOf(0, BytesOf(header, state)),
          InputOf(1, BytesOf(header, commands)),
          InputOf(2, BytesOf(header, update)),
          InputOf(3, BytesOf(header, frame)),
          InputOf(4, BytesOf(header, DrawnMessage{true})),
          InputOf(5, BytesOf(world)),
          InputOf(6, BytesOf(JoinMessage{"host:1", kProtocolVersion, 5, "engine 'ground'", true})),
          InputOf(7, BytesOf(view)),
          InputOf(8, BytesOf(ControlRequestMessage{
                         {"move", {{"entity", "fb"}, {"pose", std::vector<double>{1, 2, 0, 0, 0, 90}}}}, "host:1", 9})),
          InputOf(9, BytesOf(ControlReplyMessage{"host:1", 9, true, 7, "moved 'fb' at tick 7"})),
          InputOf(10, BytesOf(StatusMessage{5, 7, "engine 'ground'", "waits for controller host 0"})),
          InputOf(11, BytesOf(SavedStateMessage{5, 7, "engine 'ground'", {'a', 'b', 'c'}})),
          InputOf(12, BytesOf(ViewRequestMessage{"host:1", 5, 30, true, {1, 2}})),
          InputOf(13, BytesOf(status)),
          InputOf(14, BytesOf(robots)),
          InputOf(15, BytesOf(LeaveMessage{5, 7, "engine 'ground'", "", "über"})),
          InputOf(16, BytesOf(RecoveryRequestMessage{5, "host:1", "engine 'ground'", 2})),
          InputOf(17, BytesOf(RecoveryBlockMessage{5, "host:1", 2, 7, {'a', 'b'}})),
          InputOf(21, BytesOf(header, local))};
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  using namespace swarmanoid;
  if (count == 0) return 0;
  try
  {
    kTries[bytes[0] % std::size(kTries)]({reinterpret_cast<const char*>(bytes) + 1, count - 1});
  }
  catch (const BadMessage& error)
  {
    if (error.what()[0] == '\0') std::abort();
  }
  return 0;
}
