// A bad message is refused by the name of its field before it is used, and never by an exception that leaves the type
// support.
#include <gmock/gmock.h>

#include "common/bus/topics/message_type.h"
#include "common/configuration/shown_text.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

template <class... Parts>
std::string BytesOf(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '?');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

// Returns the reason of the refusal; empty if the message is accepted.
template <class Message>
std::string Refusal(const std::string& bytes)
{
  Message message;
  return test::MessageOf<BadMessage>([&] { ReadPayload(bytes, message); });
}

template <class Message>
std::string TickRefusal(const std::string& bytes)
{
  MessageHeader header;
  Message message;
  return test::MessageOf<BadMessage>(
      [&]
      {
        ReadTickPayload<Message>(
            bytes, header, [&](const MessageHeader&) { return &message; }, [](const MessageHeader&, const Message&) {});
      });
}

void Put(std::string& bytes, std::size_t at, std::uint32_t value)
{
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}
void Put(std::string& bytes, std::size_t at, double value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); }

SpaceState SampleState()
{
  SpaceState state;
  state.poses = {1, 2, 3, 4, 5, 6, 7};
  state.attributes.Add(3, 0.5);
  state.attributes.Add(77, 1);
  state.moved = {4, 9};
  return state;
}

// Where the fields of SampleState start.
constexpr std::size_t kPoses = 4 + 20;
constexpr std::size_t kFlags = kPoses + 4 + 7 * 8;
constexpr std::size_t kValues = kFlags + 4;
constexpr std::size_t kSlots = kValues + 4 + 2 * 8;

std::string SampleBytes() { return BytesOf(MessageHeader{1, 2, 0, false}, SampleState()); }

TEST(BadMessages, CutAnywhereAreRefused)
{
  const std::string state = SampleBytes();
  EXPECT_EQ(TickRefusal<SpaceState>(state), "");
  for (std::size_t length = 0; length < state.size(); ++length)
    EXPECT_NE(TickRefusal<SpaceState>(state.substr(0, length)), "") << length;

  const std::string world = BytesOf(WorldMessage{kProtocolVersion,
                                                 1,
                                                 "e",
                                                 "h",
                                                 2,
                                                 "f",
                                                 "d",
                                                 "<x/>",
                                                 3,
                                                 HostTable{2, std::vector<std::uint32_t>(2)},
                                                 false,
                                                 0.1,
                                                 0,
                                                 {'a', 'b'},
                                                 false,
                                                 {{"fb", "footbot", true, 0}},
                                                 {},
                                                 {12, {{7, 0, FaultKind::kTooSlow}}}});
  EXPECT_EQ(Refusal<WorldMessage>(world), "");
  for (std::size_t length = 0; length < world.size(); ++length)
    EXPECT_NE(Refusal<WorldMessage>(world.substr(0, length)), "") << length;
}

TEST(BadMessages, OfAnotherEncodingOrWithMoreThanPaddingAtTheEndAreRefused)
{
  std::string bytes = SampleBytes();
  EXPECT_EQ(TickRefusal<SpaceState>(bytes + std::string(3, '\0')), "");
  EXPECT_THAT(TickRefusal<SpaceState>(bytes + std::string(4, '\0')), HasSubstr("more bytes follow"));
  bytes[1] = 0;
  EXPECT_THAT(TickRefusal<SpaceState>(bytes), HasSubstr("XCDR1"));
}

TEST(BadMessages, LengthsThatCannotBeAreRefusedBeforeRoomIsMade)
{
  for (const std::uint32_t length : {8U, 0x20000001U, 0x7fffffffU, 0xffffffffU})
  {
    std::string bytes = SampleBytes();
    Put(bytes, kPoses, length);
    EXPECT_NE(TickRefusal<SpaceState>(bytes), "") << length;
  }
  std::string status = BytesOf(StatusMessage{1, 2, "name", "text"});
  Put(status, 4 + 16, 0xfffffff0U);
  EXPECT_THAT(Refusal<StatusMessage>(status), HasSubstr("name: it claims 4294967280 bytes"));
  std::string robots = BytesOf(RobotStatusMessage{1, 2, 3, {}});
  Put(robots, 4 + 20, 0x10000000U);
  EXPECT_THAT(Refusal<RobotStatusMessage>(robots), HasSubstr("robots"));
}

TEST(BadMessages, NumbersThatAreNotFiniteAreRefused)
{
  for (const double number : {HUGE_VAL, -HUGE_VAL, std::nan(""), -std::nan("")})
  {
    std::string bytes = SampleBytes();
    Put(bytes, kPoses + 4 + 3 * 8, number);
    EXPECT_THAT(TickRefusal<SpaceState>(bytes), HasSubstr("poses: a number is not finite"));
    bytes = SampleBytes();
    Put(bytes, kValues + 4 + 8, number);
    EXPECT_THAT(TickRefusal<SpaceState>(bytes), HasSubstr("attributes.values"));
    EXPECT_THAT(Refusal<ViewRequestMessage>(BytesOf(ViewRequestMessage{"x:1", 7, number, false, {}})),
                HasSubstr("views"));
  }
  // The mistake is found at any position in a long array, and for the largest numbers.
  SensorFrame frame;
  frame.values.assign(2000, std::numeric_limits<double>::max());
  EXPECT_EQ(TickRefusal<SensorFrame>(BytesOf(MessageHeader{}, frame)), "");
  for (const std::size_t k : {0U, 511U, 512U, 1023U, 1999U})
  {
    frame.values.assign(2000, -1e-310);
    frame.values[k] = std::nan("");
    EXPECT_NE(TickRefusal<SensorFrame>(BytesOf(MessageHeader{}, frame)), "") << k;
  }
}

TEST(BadMessages, PartsForRegionsAreAllOfTheBytes)
{
  RegionHaloMessage halo;
  halo.sizes = {2, 0, 1};
  halo.bytes = {1, 2, 3};
  EXPECT_EQ(TickRefusal<RegionHaloMessage>(BytesOf(MessageHeader{}, halo)), "");
  for (const std::uint32_t wrong : {0U, 2U, ~0U})
  {
    std::string bytes = BytesOf(MessageHeader{}, halo);
    constexpr std::size_t kSizes = 4 + 20 + 12 + 4;  // behind the encapsulation, the header, epoch, number and flags
    Put(bytes, kSizes + 8, wrong);
    EXPECT_THAT(TickRefusal<RegionHaloMessage>(bytes), HasSubstr("sizes: they are not those of the bytes")) << wrong;
  }
}

TEST(BadMessages, SlotsThatDoNotAscendAreRefused)
{
  for (const std::uint32_t second : {3U, 2U})
  {
    std::string bytes = SampleBytes();
    Put(bytes, kSlots + 8, second);
    EXPECT_THAT(TickRefusal<SpaceState>(bytes), HasSubstr("attributes.slots"));
  }
}

TEST(BadMessages, FlagsAndValuesThatMeanNothingAreRefused)
{
  std::string bytes = SampleBytes();
  Put(bytes, kFlags, 2 * (kFlagUniformX << 6U));
  EXPECT_THAT(TickRefusal<SpaceState>(bytes), HasSubstr("flags"));
  Put(bytes, kFlags, 2 * (kFlagUniformX << 6U) - kFlagUniformX);
  EXPECT_THAT(TickRefusal<SpaceState>(bytes), HasSubstr("poses"));
  std::string drawn = BytesOf(MessageHeader{}, DrawnMessage{true});
  Put(drawn, 4 + 20, 0x80000001U);
  EXPECT_THAT(TickRefusal<DrawnMessage>(drawn), HasSubstr("flags"));

  RunStatusMessage status;
  status.status.phase = RunStatus::Phase::kRunning;
  std::string running = BytesOf(status);
  for (const std::uint32_t phase : {0U, 5U, 0xffffffffU})
  {
    Put(running, 4 + 16, phase);
    EXPECT_THAT(Refusal<RunStatusMessage>(running), HasSubstr("phase")) << phase;
  }
  std::string reply = BytesOf(ControlReplyMessage{"", 1, true, 2, ""});
  reply[4 + 4 + 1 + 3 + 4] = 2;
  EXPECT_THAT(Refusal<ControlReplyMessage>(reply), HasSubstr("ok"));
}

TEST(BadMessages, TextsThatTerminalsObeyAreRefused)
{
  for (const std::string text : {"\x1b]0;owned\x07", "a\rb", "\x7f",
                                 "\xc2\x9b"
                                 "31m",
                                 "\xff", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"})
  {
    EXPECT_FALSE(IsShowable(text));
    EXPECT_TRUE(IsShowable(Showable(text, 100)));
    std::string bytes = BytesOf(StatusMessage{1, 2, "name", std::string(text.size(), 'x')});
    bytes.replace(bytes.find(std::string(text.size(), 'x')), text.size(), text);
    EXPECT_THAT(Refusal<StatusMessage>(bytes), HasSubstr("text: it is no UTF-8 text")) << text;
  }
  EXPECT_TRUE(IsShowable("é → 𝄞\n\ttab"));
  EXPECT_FALSE(IsShowableLine("a\nb"));
  EXPECT_EQ(ShowableLine("a\nb\tc", 100), "a?b?c");
  std::string bytes = BytesOf(StatusMessage{1, 2, "name", "text"});
  bytes[bytes.find("name") + 2] = '\n';
  EXPECT_THAT(Refusal<StatusMessage>(bytes), HasSubstr("name: it is no UTF-8 text, or has control characters"));
  bytes = BytesOf(StatusMessage{1, 2, "name", "text"});
  bytes[bytes.find("text") + 2] = '\0';
  EXPECT_THAT(Refusal<StatusMessage>(bytes), HasSubstr("text"));
}

// A text of a controller or an exception never prevents a message from being sent.
TEST(Messages, TextsAreMadeShowableAndShortWhenSent)
{
  LeaveMessage read;
  ReadPayload<LeaveMessage>(BytesOf(LeaveMessage{1, 2, "name", "", "a\x1b[31mb\xff" + std::string(100000, 'x')}), read);
  EXPECT_THAT(read.error, testing::StartsWith("a?[31mb?xxx"));
  EXPECT_EQ(read.error.size(), kLongestText);
  // A cut is not within a character.
  EXPECT_EQ(Showable("aé", 2), "a");
}

TEST(Messages, NamesThatOthersWouldRefuseAreNotSent)
{
  EXPECT_THROW(PayloadSize(StatusMessage{1, 2, "a\x1b", ""}), BadMessage);
  EXPECT_THROW(PayloadSize(StatusMessage{1, 2, "a\n2,stop", ""}), BadMessage);
  EXPECT_THROW(PayloadSize(StatusMessage{1, 2, std::string(2000, 'a'), ""}), BadMessage);
}

TEST(Messages, OfAnotherVersionTellItWhateverElseTheyHold)
{
  for (const std::uint32_t version : {kProtocolVersion - 1, kProtocolVersion + 1})
  {
    std::string bytes =
        BytesOf(WorldMessage{version, 1, "experiment", "host", 2, "", "", "", 3, {}, false, 0, 0, {}, false, {}});
    bytes.resize(bytes.size() - 20);
    WorldMessage world;
    ReadPayload<WorldMessage>(bytes, world);
    EXPECT_EQ(world.protocol, version);
    EXPECT_EQ(world.experiment, "experiment");
  }
}

// Fast DDS calls these from its own threads, where an exception would end the process.
TEST(BadMessages, NeverLeaveTheTypeSupportAsExceptions)
{
  std::string bytes = SampleBytes();
  for (std::size_t length = 0; length <= bytes.size(); ++length)
  {
    Payload payload(static_cast<std::uint32_t>(bytes.size()));
    std::memcpy(payload.data, bytes.data(), length);
    payload.length = static_cast<std::uint32_t>(length);
    SpaceState place;
    const HotSubscription<SpaceState>::Handler handler{[&](const MessageHeader&) { return &place; }, {}, {}};
    HotRead<SpaceState> hot{&handler, {}, nullptr, {}};
    EXPECT_TRUE(HotType<SpaceState>(bytes.size()).Read(payload, &hot));
    EXPECT_EQ(hot.error.empty(), length == bytes.size());
    EXPECT_EQ(hot.message == &place, length == bytes.size());

    WorldMessage world;
    ColdCall<WorldMessage> cold;
    cold.in = &world;
    EXPECT_TRUE(ColdType<WorldMessage>().Read(payload, &cold));
    EXPECT_FALSE(cold.error.empty() && world.protocol == kProtocolVersion);
  }
}

TEST(HotType, RefusesMessagesLargerThanItsRoom)
{
  const MessageHeader header;
  const SpaceState state = SampleState();
  HotWrite<SpaceState> write{&header, &state, PayloadSize(header, state)};
  Payload small(60);
  EXPECT_FALSE(HotType<SpaceState>(60).Write(&write, small));
}

}  // namespace
}  // namespace swarmanoid
