// CheckRtps accepts the datagrams that processes send, and refuses datagrams with a defect.
#include "common/bus/dds/check_rtps.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/bus/rtps_datagrams.h"

namespace swarmanoid
{
namespace
{

using namespace test;

std::string DefectOf(const std::string& datagram, const RtpsLimits& limits = kMemberLimits)
{
  const char* const defect = CheckRtps(datagram, limits).defect;
  return defect == nullptr ? "" : defect;
}

std::string NameOf(const testing::TestParamInfo<RtpsDatagram>& info) { return info.param.name; }

struct LegalRtps : testing::TestWithParam<RtpsDatagram>
{
};
INSTANTIATE_TEST_SUITE_P(All, LegalRtps, testing::ValuesIn(LegalDatagrams()), NameOf);

TEST_P(LegalRtps, IsReadWhole)
{
  const RtpsVerdict verdict = CheckRtps(GetParam().bytes);
  EXPECT_EQ(verdict.defect, nullptr) << verdict.defect;
  EXPECT_EQ(verdict.bytes, GetParam().bytes.size());
  EXPECT_EQ(DefectOf(GetParam().bytes, kStrangerLimits), "");
}

TEST_P(LegalRtps, IsReadWithoutTheStatisticsAtItsEnd)
{
  if (GetParam().bytes.substr(6, 2) != kVendorFastDds || GetParam().bytes.size() % 4 != 0) return;
  if (GetParam().name == "DataUpToTheEnd") return;
  const RtpsVerdict verdict = CheckRtps(GetParam().bytes + Statistics());
  EXPECT_EQ(verdict.defect, nullptr);
  EXPECT_EQ(verdict.bytes, GetParam().bytes.size());
}

// Copies of exactly their length, so that tools see a byte read too many.
TEST_P(LegalRtps, IsReadWithinItsBoundsWhereverItEnds)
{
  for (std::size_t size = 0; size < GetParam().bytes.size(); ++size)
  {
    const auto exact = std::make_unique<char[]>(size + 1);
    std::copy_n(GetParam().bytes.begin(), size, exact.get());
    const RtpsVerdict verdict = CheckRtps({exact.get(), size});
    EXPECT_LE(verdict.bytes, size);
    EXPECT_TRUE(size >= 20 || verdict.defect != nullptr) << size;
  }
}

struct AttackByRtps : testing::TestWithParam<RtpsDatagram>
{
};
INSTANTIATE_TEST_SUITE_P(All, AttackByRtps, testing::ValuesIn(AttackDatagrams()), NameOf);

TEST_P(AttackByRtps, IsRefusedWhereverItStands)
{
  const RtpsDatagram& attack = GetParam();
  EXPECT_NE(DefectOf(attack.bytes).find(attack.defect), std::string::npos) << DefectOf(attack.bytes);
  const std::string behind = RtpsHeader() + RtpsSubmessage(0x0e, 0, std::string(12, 'd')) + attack.bytes.substr(20);
  const RtpsVerdict verdict = CheckRtps(behind);
  ASSERT_NE(verdict.defect, nullptr);
  EXPECT_EQ(verdict.bytes, 36U);
}

TEST(CheckRtps, RefusesWhatIsNoDatagramOfRtps2)
{
  for (const std::string& bytes :
       {std::string(), std::string("RTPS\2\3\1\17", 8), std::string(40, 'x'),
        std::string("RTPX") + RtpsHeader().substr(4), std::string("RTPS\1") + RtpsHeader().substr(5)})
    EXPECT_EQ(DefectOf(bytes), "it is no datagram of RTPS 2");
}

TEST(CheckRtps, RefusesSubmessagesThatDoNotFit)
{
  const std::string beat = Heartbeat(1, 0);
  EXPECT_EQ(DefectOf(RtpsHeader() + "\7\1\1"), "a submessage that ends before its length");
  EXPECT_EQ(DefectOf(RtpsHeader() + beat.substr(0, beat.size() - 1)), "a submessage that is longer than its datagram");
  EXPECT_EQ(DefectOf(RtpsHeader() + RtpsSubmessage(0x9d, 0, "vvv") + beat),
            "a submessage whose length is no multiple of 4");
}

TEST(CheckRtps, RefusesSubmessagesThatAreShorterThanTheirFields)
{
  for (const unsigned kind : {0x06U, 0x07U, 0x08U, 0x09U, 0x0cU, 0x0dU, 0x0eU, 0x0fU, 0x12U, 0x13U, 0x15U, 0x16U})
    EXPECT_NE(DefectOf(RtpsHeader() + RtpsSubmessage(kind, 0, "1234") + Heartbeat(1, 0)), "") << kind;
}

TEST(CheckRtps, ReadsNumbersInBothOrdersOfBytes)
{
  const auto big = [](const std::string& first, const std::string& last)
  {
    return RtpsHeader() + std::string("\7\0\0\x1c", 4) + kUnknown + kUserWriter + std::string(4, '\0') + first +
           std::string(4, '\0') + last + std::string(4, '\0');
  };
  EXPECT_EQ(DefectOf(big(std::string("\0\0\0\5", 4), std::string("\0\0\0\4", 4))), "");
  EXPECT_NE(DefectOf(big(std::string("\0\0\0\5", 4), std::string("\0\0\0\3", 4))), "");
}

TEST(CheckRtps, RefusesNumbersThatDoNotExist)
{
  constexpr std::int64_t kFar = std::int64_t{1} << 61;
  const std::string payload = kPlainEncapsulation;
  for (const std::string& submessage :
       {Heartbeat(5, 3), Heartbeat(1, kFar), Heartbeat(kFar, kFar), Gap(0, 1), Gap(5, 4), Gap(kFar, kFar), Gap(-1, 5),
        AckNack(-1, 0), AckNack(kFar, 0), AckNack(0, 1), NackFragment(1, 0, 0), NackFragment(~0U, 0),
        Data(kUserWriter, kHasData, payload, 0), Data(kUserWriter, kHasData, payload, kFar),
        DataFragment({.number = 0}, std::string(1024, 'f')),
        RtpsSubmessage(0x13, 0, kUnknown + kUserWriter + SequenceNumber(1) + Word(0) + Word(1))})
    EXPECT_NE(DefectOf(RtpsHeader() + submessage), "");
}

TEST(CheckRtps, RefusesSetsOfNumbersThatDoNotFit)
{
  for (const std::uint32_t bits : {33U, 256U, 257U, ~0U})
    for (const std::string& submessage : {Gap(1, 2, bits), AckNack(1, bits), NackFragment(1, bits)})
      EXPECT_NE(DefectOf(RtpsHeader() + submessage).find("a set of"), std::string::npos) << bits;
}

TEST(CheckRtps, RefusesGapsThatTakeLongToCount)
{
  EXPECT_EQ(DefectOf(RtpsHeader() + Gap(5, 10'005)), "");
  EXPECT_EQ(DefectOf(RtpsHeader() + Gap(5, 10'006)), "a GAP of more than 10,000 messages");
}

TEST(CheckRtps, LetsMembersGoOnForWeeksAndOthersSayLittle)
{
  const std::string late = RtpsHeader() + Heartbeat(200'001, 200'002);
  EXPECT_EQ(DefectOf(late), "");
  EXPECT_EQ(DefectOf(late, kStrangerLimits), "a HEARTBEAT of numbers that its sender cannot have");
  EXPECT_EQ(DefectOf(RtpsHeader() + Heartbeat((std::int64_t{1} << 32) + 1, std::int64_t{1} << 33)),
            "a HEARTBEAT of numbers that its sender cannot have");
  EXPECT_EQ(DefectOf(RtpsHeader() + Gap(4'000, 4'001), kStrangerLimits),
            "a GAP of numbers that its sender cannot have");
  const std::string large = RtpsHeader() + DataFragment({.sample = 300'000}, std::string(1024, 'f'));
  EXPECT_EQ(DefectOf(large), "");
  EXPECT_EQ(DefectOf(large, kStrangerLimits), "a DATA_FRAG of a message that its sender cannot have");
}

TEST(CheckRtps, RefusesFragmentsThatDoNotFitIntoTheirMessage)
{
  const std::string data(1024, 'f');
  for (const Fragment& fragment :
       {Fragment{.start = 0}, Fragment{.start = 3}, Fragment{.start = ~0U}, Fragment{.count = 0}, Fragment{.count = 2},
        Fragment{.size = 0}, Fragment{.size = 4}, Fragment{.size = 1022}, Fragment{.size = 1028}, Fragment{.sample = 0},
        Fragment{.sample = ~0U}, Fragment{.writer = kTellsTheirWriters}})
    EXPECT_NE(DefectOf(RtpsHeader() + DataFragment(fragment, data)), "")
        << fragment.start << " " << fragment.count << " " << fragment.size << " " << fragment.sample;
}

TEST(CheckRtps, RefusesDataWithoutWhatItsFlagsAnnounce)
{
  const std::string payload = kPlainEncapsulation + "text";
  EXPECT_EQ(DefectOf(RtpsHeader() + Data(kUserWriter, kHasData, "\0\1")),
            "a DATA without the data that its flags announce");
  EXPECT_EQ(DefectOf(RtpsHeader() + Data(kUserWriter, kHasKey, "")), "a DATA without the data that its flags announce");
  EXPECT_EQ(DefectOf(RtpsHeader() + Data(kUserWriter, kHasData | kHasKey, payload)), "a DATA with both data and a key");
  EXPECT_EQ(DefectOf(RtpsHeader() + Data(kUserWriter, kHasData | kInlineQos, payload)),
            "a parameter that does not fit into its list");
  EXPECT_EQ(DefectOf(RtpsHeader() + Data(kTellsParticipants, 0, "")), "a message of discovery without data");
  std::string elsewhere = RtpsHeader() + Data(kUserWriter, kHasData, payload);
  for (const char at : {'\0', '\x0c', '\x14', '\xff'})
  {
    elsewhere[26] = at;
    EXPECT_EQ(DefectOf(elsewhere), "an inline quality of service at another place than RTPS says");
  }
}

TEST(CheckRtps, RefusesListsOfParametersThatDoNotFit)
{
  for (const std::string& list :
       {std::string(), Parameter(0x50, std::string(16, 'g')), Short(0x0888) + Short(8) + "1234" + kListEnd,
        Short(0x0888) + Short(3) + "123" + kListEnd, Parameter(0x50, std::string(12, 'g')) + kListEnd,
        Parameter(0x32, std::string(20, 'l')) + kListEnd, Parameter(0x15, std::string(8, 'v')) + kListEnd,
        Parameter(0x02, Word(~0U) + Word(0)) + kListEnd, Parameter(0x70, std::string(4, 'k')) + kListEnd,
        Parameter(0x800f, std::string(28, 'i')) + kListEnd})
    EXPECT_NE(DefectOf(Announcement(list)), "") << list.size();
}

TEST(CheckRtps, RefusesTextsAndSequencesThatDoNotFit)
{
  const std::string unended = Word(4) + "text";
  for (const unsigned id : {0x05U, 0x07U, 0x62U})
    for (const std::string& text : {std::string(), Word(0), Word(5) + "text", unended, Word(~0U) + "text"})
      EXPECT_NE(DefectOf(Announcement(Parameter(id, text) + kListEnd)), "") << id << " " << text.size();
  for (const unsigned id : {0x29U, 0x2cU, 0x2dU, 0x2eU, 0x59U, 0x73U, 0x8006U})
    for (const std::string& items : {std::string(), Word(9) + "12345678", Word(~0U) + CdrString("t")})
      EXPECT_NE(DefectOf(Announcement(Parameter(id, items) + kListEnd)), "") << id << " " << items.size();
  EXPECT_NE(DefectOf(Announcement(Parameter(0x29, Word(1) + unended) + kListEnd)), "");
  EXPECT_NE(DefectOf(Announcement(Parameter(0x35, CdrString("a") + CdrString("b")) + kListEnd)), "");
  for (const unsigned id : {0x69U, 0x72U, 0x75U})
    EXPECT_NE(DefectOf(Announcement(Parameter(id, std::string(5000, 't')) + kListEnd)), "");
}

}  // namespace
}  // namespace swarmanoid
