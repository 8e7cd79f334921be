// Signed datagrams of RTPS, and the treatment of unsigned ones.
#include "common/bus/security/datagram_signatures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace swarmanoid
{
namespace
{

constexpr char kLost = 0x08;
constexpr char kInfoSource = 0x0c;
constexpr char kInfoDestination = 0x0e;
constexpr char kDataOf = 0x15;
constexpr char kDataFragmentOf = 0x16;
constexpr char kStatisticsOf = static_cast<char>(0x80);

const std::string kMember = "the member 1";
const std::string kStranger = "the stranger";

RunKey KeyOf(unsigned char byte)
{
  RunKey key;
  key.fill(byte);
  return key;
}

std::string Header(const std::string& prefix) { return std::string("RTPS\2\3\1\17", 8) + prefix; }

std::string Submessage(char kind, const std::string& body)
{
  return std::string{kind, 1, static_cast<char>(body.size()), 0} + body;
}

// Returns a submessage of a writer with its inline qualities.
std::string Data(char kind, const std::string& writer, const std::string& qualities)
{
  return Submessage(kind,
                    std::string("\0\0\20\0", 4) + std::string(4, '\0') + writer + std::string(8, '\0') + qualities);
}

const std::string kStatisticsAtEnd = Submessage(kStatisticsOf, std::string(56, '\0'));
const std::string kAnnouncer("\0\1\0\xc2", 4);
const std::string kTellsWriters("\0\0\3\xc2", 4);
const std::string kOfUser("\0\0\1\3", 4);

struct Datagrams : testing::Test
{
  static std::shared_ptr<KeyRing> Ring(std::optional<RunKey> key) { return std::make_shared<KeyRing>(0, key); }

  DatagramSignatures member{Ring(KeyOf(1))};
  DatagramSignatures reader{Ring(KeyOf(1)), {}};
  DatagramSignatures other{Ring(KeyOf(2))};

  static std::string Signed(DatagramSignatures& by, const std::string& datagram)
  {
    std::vector<char> room;
    const auto bytes = by.Sign(datagram, room);
    return {bytes.begin(), bytes.end()};
  }
  static std::string Heard(DatagramSignatures& by, const std::string& datagram)
  {
    const auto checked = by.Check(datagram);
    EXPECT_EQ(checked.forged.has_value(), checked.datagram.empty());
    return {checked.datagram.begin(), checked.datagram.end()};
  }
  // The reader knows the member from then on.
  void Meet() { ASSERT_FALSE(Heard(reader, Signed(member, Header(kMember) + Submessage(kLost, "12345678"))).empty()); }
};

TEST_F(Datagrams, ComeAsTheyWereBeforeTheyWereSigned)
{
  const std::string text = Header(kMember) + Submessage(kLost, "12345678");
  const std::string bytes = Signed(member, text);
  EXPECT_EQ(bytes.size(), text.size() + DatagramSignatures::kBytes);
  EXPECT_EQ(Heard(reader, bytes), text);
  EXPECT_NE(Signed(member, text), bytes);
}

TEST_F(Datagrams, KeepTheStatisticsOfFastDdsAtTheirEndOnTheWire)
{
  const std::string text = Header(kMember) + Submessage(kLost, "12345678");
  std::string bytes = Signed(member, text + kStatisticsAtEnd);
  EXPECT_TRUE(bytes.ends_with(kStatisticsAtEnd));
  bytes.back() = 7;  // which it fills in afterwards
  EXPECT_EQ(Heard(reader, bytes), text);
}

TEST_F(Datagrams, OfAMemberAreNotHeardWithoutASignature)
{
  const std::string text = Header(kMember) + Submessage(kLost, "12345678");
  EXPECT_EQ(Heard(reader, text), text);
  Meet();
  EXPECT_EQ(Heard(reader, text), "");
  EXPECT_EQ(Heard(reader, Signed(other, text)), "");
  const std::string bytes = Signed(member, text);
  for (std::size_t at = 0; at < bytes.size(); ++at)
  {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    const std::string heard = Heard(reader, changed);
    EXPECT_NE(heard, text) << at;
    // Under another prefix the datagram is that of a stranger.
    const bool has_its_name = at < 8 || at >= 20;
    EXPECT_TRUE(!has_its_name || heard.empty()) << at;
  }
}

TEST_F(Datagrams, OfOthersAreHeard)
{
  Meet();
  for (const std::string& body :
       {Submessage(kLost, "12345678"), Submessage(kInfoDestination, kMember) + Submessage(kLost, "12345678"),
        Data(kDataOf, kAnnouncer, std::string("\x0f\x80\x18\0", 4) + kMember + std::string(12, '\0')),
        Data(kDataFragmentOf, kOfUser, "text")})
  {
    const std::string text = Header(kStranger) + body;
    EXPECT_EQ(Heard(reader, text), text);
    EXPECT_EQ(Heard(reader, Signed(other, text)), text);
  }
}

TEST_F(Datagrams, OfOthersSayNothingForOrAboutAMember)
{
  Meet();
  const std::string own = Submessage(kLost, "12345678");
  for (const std::string& body :
       {Submessage(kInfoSource, std::string(8, '\0') + kMember), Data(kDataOf, kAnnouncer, "pG\20\0" + kMember),
        Data(kDataOf, kTellsWriters, std::string("\x0f\x80\x18\0", 4) + kMember),
        // The content of a split announcement cannot be checked.
        Data(kDataFragmentOf, kTellsWriters, "text")})
    for (const std::string& before : {std::string(), own, Submessage(0x09, ""), Submessage(kInfoDestination, kMember)})
      EXPECT_EQ(Heard(reader, Header(kStranger) + before + body + own), "");
}

// The limits for strangers apply only in processes that can tell strangers from members.
TEST_F(Datagrams, OfStrangersAreKnownToProcessesThatHaveAKey)
{
  const std::string text = Header(kStranger) + Submessage(kLost, "12345678");
  EXPECT_TRUE(reader.Check(text).is_of_stranger);
  EXPECT_TRUE(reader.Check(Signed(other, text)).is_of_stranger);
  EXPECT_FALSE(reader.Check(Signed(member, text)).is_of_stranger);
  DatagramSignatures outsider(Ring(std::nullopt));
  EXPECT_FALSE(outsider.Check(text).is_of_stranger);
}

TEST_F(Datagrams, OfStrangersThatAnnounceThemselvesAreHeardUpToALimit)
{
  const auto announces = [](DatagramSignatures& to, std::size_t number)
  {
    std::string prefix = kStranger;
    prefix[0] = static_cast<char>(number);
    prefix[1] = static_cast<char>(number >> 8U);
    return to.Check(Header(prefix) + Data(kDataOf, kAnnouncer, "text"));
  };
  constexpr std::size_t kMost = DatagramSignatures::kMostStrangers;
  for (std::size_t k = 0; k < kMost; ++k) EXPECT_FALSE(announces(reader, k).is_one_too_many);
  EXPECT_TRUE(announces(reader, kMost).is_one_too_many);
  EXPECT_TRUE(announces(reader, kMost).datagram.empty());
  EXPECT_FALSE(announces(reader, 0).is_one_too_many);
  const std::string of_member = Header(kMember) + Data(kDataOf, kAnnouncer, "text");
  EXPECT_EQ(Heard(reader, Signed(member, of_member)), of_member);

  DatagramSignatures forgetful(Ring(KeyOf(1)), {}, {});
  DatagramSignatures outsider(Ring(std::nullopt));
  for (std::size_t k = 0; k <= kMost; ++k)
  {
    EXPECT_FALSE(announces(forgetful, k).is_one_too_many);
    EXPECT_FALSE(announces(outsider, k).is_one_too_many);
  }
}

// Datagrams from before the first signature may come late, so they are not reported as forged.
TEST_F(Datagrams, FromBeforeTheFirstSignatureAreNotTold)
{
  DatagramSignatures settling(Ring(KeyOf(1)));
  const std::string text = Header(kMember) + Submessage(kLost, "12345678");
  ASSERT_FALSE(settling.Check(Signed(member, text)).datagram.empty());
  const auto late = settling.Check(text);
  EXPECT_TRUE(late.datagram.empty());
  EXPECT_FALSE(late.forged.has_value());
}

TEST_F(Datagrams, OfWhoHasNoKeyAreNotSigned)
{
  DatagramSignatures outsider(Ring(std::nullopt));
  const std::string text = Header(kStranger) + Submessage(kLost, "12345678");
  EXPECT_EQ(Signed(outsider, text), text);
  EXPECT_EQ(Heard(outsider, Signed(member, Header(kMember))), Header(kMember));
}

// CheckRtps (check_rtps.h) refuses what has no meaning. Signatures let it pass as it is, and it changes nothing for
// members.
TEST_F(Datagrams, WithoutMeaningPassUnchangedAndChangeNothingForMembers)
{
  Meet();
  std::string text = Header(kStranger);
  for (int k = 0; k < 300; ++k)
  {
    text += static_cast<char>(k * 37);
    for (std::size_t size = 1; size <= std::min<std::size_t>(23, text.size()); ++size)
    {
      const std::string end = text.substr(text.size() - size);
      EXPECT_EQ(Heard(reader, end), end) << k << ", the last " << size << " bytes";
    }
    EXPECT_EQ(Heard(reader, text), text) << k;
    EXPECT_TRUE(reader.Check(text).is_of_stranger) << k;
  }
  const std::string of_member = Header(kMember) + Submessage(kLost, "12345678");
  EXPECT_EQ(Heard(reader, Signed(member, of_member)), of_member);
  EXPECT_TRUE(reader.Check(of_member).forged.has_value()) << "without its signature";
}

}  // namespace
}  // namespace swarmanoid
