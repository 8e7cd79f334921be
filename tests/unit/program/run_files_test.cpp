// Tests the texts that the programs of a run print, log and name: the last line, the hash log, grants, addresses.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

#include "common/configuration/utf8.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_writer.h"
#include "common/run/access/access_grant.h"
#include "common/run/access/addresses.h"
#include "common/run/access/bus_options.h"
#include "common/run/hash_log.h"
#include "common/run/run_summary.h"
#include "common/run/visualiser_name.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

TEST(RunSummary, TheLastLineHasTicksEntitiesHashTimeAndPace)
{
  RunSummary summary;
  summary.ticks = 500;
  summary.entities = 11;
  summary.hash = 0xabcULL;
  summary.wall_s = 1.23456;
  summary.real_time_factor = 40.56;
  EXPECT_EQ(FinishedLine(summary), "finished: 500 ticks, 11 entities, hash 0000000000000abc, 1.235 s, 40.6x real time");
  EXPECT_DOUBLE_EQ(RealTimeFactor(50, 0.1, 2), 2.5);
  EXPECT_EQ(RealTimeFactor(50, 0.1, 0), 0) << "no time has passed";
}

TEST(VisualiserName, HasTheIdOfTheVisualisation)
{
  RenderConfiguration render;
  render.tag = "text_render";
  render.id = "table";
  EXPECT_EQ(VisualiserName(render), "visualiser 'table'");
}

class HashLogTest : public testing::Test
{
protected:
  std::string Path() const { return folder_ / "hashes"; }
  void Write(std::uint64_t first, std::uint64_t end, std::optional<std::uint64_t> goes_on_at = std::nullopt) const
  {
    HashLog log(Path(), goes_on_at);
    for (std::uint64_t tick = first; tick < end; ++tick) log.Write(tick, 0x10 + tick);
    log.Close();
  }
  std::string Mistake(const std::string& text) const
  {
    folder_.Write("hashes", text);
    return test::MessageOf<std::runtime_error>([&] { ReadHashLog(Path()); });
  }

  const test::TemporaryFolder folder_;
};

TEST_F(HashLogTest, HasALineOfTickAndHashForEachTick)
{
  EXPECT_EQ(HashLogLine({7, 0xabc}), "7 0000000000000abc\n");
  Write(3, 5);
  EXPECT_EQ(folder_.Read("hashes"), "3 0000000000000013\n4 0000000000000014\n");
  EXPECT_THAT(ReadHashLog(Path()), ElementsAre(TickHash{3, 0x13}, TickHash{4, 0x14}));
  Write(0, 1);
  EXPECT_THAT(ReadHashLog(Path()), ElementsAre(TickHash{0, 0x10})) << "another run begins the file again";
}

TEST_F(HashLogTest, KeepsTheLinesBeforeTheTickAtWhichARunGoesOn)
{
  Write(0, 6);
  Write(4, 5, 4);
  EXPECT_THAT(ReadHashLog(Path()), ElementsAre(TickHash{0, 0x10}, TickHash{1, 0x11}, TickHash{2, 0x12},
                                               TickHash{3, 0x13}, TickHash{4, 0x14}));
  Write(9, 10, 100);
  EXPECT_EQ(ReadHashLog(Path()).size(), 6U) << "all earlier lines stay";
  folder_.Write("hashes", "0 0000000000000010\n1 00000000000");  // the last line was being written
  Write(1, 2, 1);
  EXPECT_THAT(ReadHashLog(Path()), ElementsAre(TickHash{0, 0x10}, TickHash{1, 0x11}));
  for (const char* damaged : {"0 0000000000000010\n2 0000000000000010\n3 0000000000000010\n", "nonsense\n"})
  {
    folder_.Write("hashes", damaged);
    EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { HashLog(Path(), 3); }), HasSubstr("is damaged")) << damaged;
  }
}

TEST_F(HashLogTest, SurvivesAKillOnceItIsFlushed)
{
  HashLog log(Path());
  EXPECT_TRUE(log.IsOpen());
  log.Write(0, 1);
  log.Flush();
  EXPECT_EQ(folder_.Read("hashes"), "0 0000000000000001\n");
}

TEST_F(HashLogTest, IsNotWrittenWithoutAPathAndSaysWhyItCannotBe)
{
  HashLog none("");
  EXPECT_FALSE(none.IsOpen());
  none.Write(0, 1);
  none.Flush();
  none.Close();
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { HashLog(folder_ / "missing" / "file"); }),
              HasSubstr("cannot write the hash log"));
  HashLog full("/dev/full");
  full.Write(0, 1);
  EXPECT_THROW(full.Flush(), std::runtime_error);
}

TEST_F(HashLogTest, IsReadOnlyIfEachLineIsThatOfALaterTick)
{
  EXPECT_EQ(Mistake("0 0000000000000010\n2 0000000000000010\n"), "") << "ticks may be missing";
  for (const char* line : {"0 0000000000000010", "1 000000000000010", "1 00000000000000010", "1", "1 ",
                           "x 0000000000000010", "1  000000000000010", "1 000000000000001g", ""})
    EXPECT_THAT(Mistake("0 0000000000000010\n" + std::string(line) + "\n"),
                HasSubstr("hashes:2: the hash log is damaged"))
        << line;
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { ReadHashLog(folder_ / "none"); }), HasSubstr("cannot read"));
}

TEST(GrantRole, HasAWordForTokensAndANameForPeople)
{
  const std::tuple<GrantRole, const char*, const char*> rows[] = {
      {GrantRole::kWatcher, "watch", "watcher grant 1a2b3c4d"},
      {GrantRole::kOperator, "operate", "operator grant 1a2b3c4d"},
      {GrantRole::kOpenView, "open", "open view 1a2b3c4d"}};
  for (const auto& [role, word, name] : rows)
  {
    EXPECT_STREQ(RoleWord(role), word);
    EXPECT_EQ(GrantRoleOf(word), role);
    EXPECT_EQ((AccessGrant{"1a2b3c4d", role, 0}.Name()), name);
  }
  EXPECT_FALSE(GrantRoleOf("watcher"));
  EXPECT_FALSE(GrantRoleOf(""));
}

TEST(GrantId, HasEightHexadecimalDigitsAndIsDrawn)
{
  std::set<std::string> ids;
  for (int k = 0; k < 20; ++k) ids.insert(NewGrantId());
  EXPECT_GT(ids.size(), 18U);
  for (const std::string& id : ids) EXPECT_TRUE(IsGrantId(id)) << id;
  for (const char* text : {"", "1a2b3c4", "1a2b3c4d5", "1A2b3c4d", "1a2b3c4g", "1a2b 3c4"})
    EXPECT_FALSE(IsGrantId(text));
}

TEST(UtcText, IsATimeOfIso8601)
{
  EXPECT_EQ(UtcText(0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(UtcText(951'782'399), "2000-02-28T23:59:59Z");
  EXPECT_EQ(UtcText(951'782'400), "2000-02-29T00:00:00Z");
}

TEST(BusOptions, HaveLargeDatagramsOnThisMachineAndPacketsOnANetwork)
{
  BusOptions options;
  EXPECT_EQ(options.domain, 77);
  EXPECT_FALSE(options.Spread());
  EXPECT_EQ(options.DatagramBytes(), 65500U);
  options.network_interface = "all";
  EXPECT_TRUE(options.Spread());
  EXPECT_EQ(options.DatagramBytes(), 1440U);
  options.datagram_bytes = 9000;
  EXPECT_EQ(options.DatagramBytes(), 9000U);
}

TEST(Addresses, OfTheInterfacesOfThisMachine)
{
  EXPECT_THAT(InterfaceAddresses("lo"), ElementsAre("127.0.0.1"));
  EXPECT_THAT(InterfaceAddresses("127.0.0.1"), ElementsAre("127.0.0.1"));
  EXPECT_TRUE(InterfaceAddresses("all").empty());
  const std::string mistake = test::MessageOf<BusError>([] { InterfaceAddresses("no_such_interface"); });
  EXPECT_THAT(mistake, HasSubstr("no network interface 'no_such_interface'; there are lo, all"));
  EXPECT_THAT(mistake, HasSubstr("lo (127.0.0.1)"));
  EXPECT_EQ(ReachableAddress(BusOptions()), "127.0.0.1");
  EXPECT_EQ(ResolveHost("127.0.0.1"), "127.0.0.1");
  EXPECT_EQ(ResolveHost("10.77.0.1"), "10.77.0.1");
}

// The rows are those of table 3-7 of Unicode 15.
TEST(Utf8Length, IsThatOfWellFormedCharactersOnly)
{
  const std::pair<const char*, std::size_t> rows[] = {{"a", 1},
                                                      {"\x7f", 1},
                                                      {"\xc2\x80", 2},
                                                      {"\xdf\xbf", 2},
                                                      {"\xe0\xa0\x80", 3},
                                                      {"\xec\xbf\xbf", 3},
                                                      {"\xed\x9f\xbf", 3},
                                                      {"\xef\xbf\xbf", 3},
                                                      {"\xf0\x90\x80\x80", 4},
                                                      {"\xf4\x8f\xbf\xbf", 4},
                                                      {"\x80", 0},
                                                      {"\xbf", 0},
                                                      {"\xc1\xbf", 0},
                                                      {"\xc2", 0},
                                                      {"\xc2\x7f", 0},
                                                      {"\xc2\xc0", 0},
                                                      {"\xe0\x9f\xbf", 0},
                                                      {"\xed\xa0\x80", 0},
                                                      {"\xe1\x80", 0},
                                                      {"\xf0\x8f\xbf\xbf", 0},
                                                      {"\xf4\x90\x80\x80", 0},
                                                      {"\xf5\x80\x80\x80", 0},
                                                      {"\xf1\x80\x80", 0},
                                                      {"\xff", 0},
                                                      {"ab", 1}};
  for (const auto& [text, length] : rows) EXPECT_EQ(Utf8Length(text), length) << testing::PrintToString(text);
}

TEST(EscapedXml, HasNoCharacterThatReadersTakeForMarkup)
{
  EXPECT_EQ(EscapedXml("a < b > c & \"d\" 'e'\r\n\t"), "a &lt; b &gt; c &amp; &quot;d&quot; 'e'&#13;\n\t");
  EXPECT_EQ(EscapedAttribute("a\n\t<"), "a&#10;&#9;&lt;");
}

TEST(Wording, QuotesAreOneLineAndShort)
{
  EXPECT_EQ(Quoted("a\nb\x1b"), "'a b '");
  EXPECT_EQ(Quoted(std::string(60, 'a')), "'" + std::string(60, 'a') + "'");
  EXPECT_EQ(Quoted(std::string(61, 'a')), "'" + std::string(60, 'a') + "…'");
  EXPECT_EQ(Quoted(std::string(59, 'a') + "é"), "'" + std::string(59, 'a') + "…'") << "no character is cut";
  EXPECT_EQ(Listed({}), "none");
  EXPECT_EQ(Listed({"a", "b"}), "a, b");
  EXPECT_EQ(DidYouMean("paus", {"resume", "pause"}), "; did you mean 'pause'?");
  EXPECT_EQ(DidYouMean("xyz", {"resume", "pause"}), "");
  EXPECT_EQ(DidYouMean("spede", {"step", "speed"}), "; did you mean 'speed'?") << "neighbours changed places";
  EXPECT_EQ(DidYouMean("conv", {"convert"}), "; did you mean 'convert'?") << "it is the beginning";
  EXPECT_EQ(DidYouMean("PAUSE", {"pause"}), "; did you mean 'pause'?");
}

}  // namespace
}  // namespace swarmanoid
