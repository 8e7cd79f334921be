// Logs of events, complete, cut short and damaged; and logs of hashes that a resumed run continues.
#include "space_server/event_log.h"

#include <fstream>

#include <gmock/gmock.h>

#include "common/configuration/configuration_tree.h"
#include "common/run/hash_log.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kHeader = "tick,request,entity,numbers,from,number,when\n";
constexpr const char* kMove = "5,move,fb_0,1 2 0,user@host:1,1,2031-05-17T09:30:00Z\n";
constexpr const char* kStop = "9,stop,,,user@host:1,2,2031-05-17T09:30:01Z\n";

class EventLogTest : public testing::Test
{
protected:
  EventLogTest() { experiment_.entities.push_back(test::Entity(EntityKind::kFootbot, "fb_0")); }

  std::string File(const std::string& text) const { return folder_.Write("events.csv", text); }
  std::size_t CountOf(const std::string& text) const { return ReadEvents(File(text), experiment_).size(); }
  std::string MistakeOf(const std::string& text) const
  {
    return test::MessageOf<ConfigurationError>([&] { ReadEvents(File(text), experiment_); }, "none");
  }

  const test::TemporaryFolder folder_;
  Experiment experiment_;
};

TEST_F(EventLogTest, ALastLineThatARunDidNotEndIsLeftOutAndTold)
{
  const std::string whole = std::string(kHeader) + kMove + kStop;
  EXPECT_EQ(CountOf(whole), 2U);
  for (std::size_t length = whole.size() - 1; length > whole.size() - std::string(kStop).size(); --length)
  {
    testing::internal::CaptureStderr();
    EXPECT_EQ(CountOf(whole.substr(0, length)), 1U) << length;
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("events.csv:3: note: the last line was cut short"));
  }
  EXPECT_EQ(CountOf("5,stop,,"), 1U) << "by hand, without a header";
}

TEST_F(EventLogTest, ADamagedLineIsRefusedWithItsPlace)
{
  for (const char* line :
       {"x,move,fb_0,1 2 0,u@h:1,1,\n", "5\n", "5,mXve,fb_0,1 2 0,u@h:1,1,\n", "5,move,fb_1,1 2 0,u@h:1,1,\n",
        "5,move,fb_0,1 b 0,u@h:1,1,\n", "5,move,fb_0,1 2 0,u@h:1,1x,\n", "5,move,fb_0,1 2 0,u@h:1;1,when\n",
        "5,move,fb_0,1 2 0,u@h:1,99999999999,\n", "5,move,fb_0,1 2 0,u@h:1,1,when,more\n"})
    EXPECT_THAT(MistakeOf(std::string(kHeader) + line + kStop), HasSubstr("events.csv:2")) << line;
}

TEST_F(EventLogTest, AnotherValueInALineDoesNotFitItsChecksum)
{
  const std::string path = (folder_ / "written.csv").string();
  {
    EventLog log(path);
    log.Write(5, {{"move", {{"entity", "fb_0"}, {"pose", std::vector<double>{1, 2, 0}}}}});
  }
  const std::string good = test::TextOf(path);
  EXPECT_EQ(CountOf(good), 1U);
  for (std::size_t at = good.find('\n') + 1; at + 1 < good.size(); ++at)
  {
    std::string flipped = good;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    EXPECT_THAT(MistakeOf(flipped), HasSubstr("events.csv:2")) << flipped;
    EXPECT_THAT(ReadEventLines(File(flipped)).damaged, SizeIs(1)) << flipped;
  }
  EXPECT_EQ(CountOf(good.substr(0, good.rfind(',') + 1) + "\n"), 1U) << "by hand, without a checksum";
}

TEST_F(EventLogTest, LinesThatAreNotRepeatedMayBeOfAnotherVersion)
{
  EXPECT_EQ(CountOf(std::string(kHeader) + "1,move-host,1 to beta,,u@h:1,1,\n2,share,0000000a,1 0,u@h:1,2,\n" + kMove),
            1U);
}

TEST_F(EventLogTest, ARunThatGoesOnHasThePaceAndTheGrantsOfItsLog)
{
  const std::string path = File(std::string(kHeader) +
                                "1,pause,,,u@h:1,1,\n1,speed,,2.5,u@h:1,2,\n2,share,0000000a,operate 0,u@h:1,3,\n"
                                "2,share,0000000b,open 7,u@h:1,4,\n3,revoke,0000000a,,u@h:1,5,\n"
                                "4,refused,Join,,stranger,0,\n5,step,,10,u@h:1,6,\n" +
                                kMove);
  const EarlierRequests earlier = ReadEarlierRequests(path, experiment_, std::nullopt);
  EXPECT_EQ(earlier.speed, 2.5);
  EXPECT_EQ(earlier.pause_at, 15U);
  ASSERT_TRUE(earlier.step);
  EXPECT_EQ(earlier.step->number, 6U);
  ASSERT_EQ(earlier.grants.size(), 1U);
  EXPECT_EQ(earlier.grants[0].Get<std::string>("role"), "open");
  EXPECT_EQ(earlier.grants[0].Get<std::int64_t>("ends"), 7);
  EXPECT_THAT(earlier.changes, SizeIs(1));
  EXPECT_THAT(earlier.answered, SizeIs(4));
}

TEST_F(EventLogTest, LinesThatArePassedOnAreReadAroundDamage)
{
  const EventLines events = ReadEventLines(File(std::string(kHeader) + kMove + "what is this\n" + kStop + "10,st"));
  ASSERT_EQ(events.lines.size(), 2U);
  EXPECT_EQ(events.lines[0].tick, 5U);
  EXPECT_EQ(events.lines[1].text + "\n", kStop);
  EXPECT_THAT(events.damaged, ElementsAre(HasSubstr("events.csv:3: 'what is this' is no event")));
  EXPECT_THAT(ReadEventLines((folder_ / "none.csv").string()).lines, IsEmpty());
}

TEST_F(EventLogTest, AHashLogGoesOnAtItsTick)
{
  const std::string path = (folder_ / "hashes.txt").string();
  {
    HashLog log(path);
    for (std::uint64_t tick = 3; tick < 10; ++tick) log.Write(tick, tick * 1234567);
  }
  std::ofstream(path, std::ios::app) << "10 00";
  {
    HashLog log(path, 7);
    log.Write(7, 1);
  }
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  EXPECT_THAT(lines,
              ElementsAre(HasSubstr("3 "), HasSubstr("4 "), HasSubstr("5 "), HasSubstr("6 "), "7 0000000000000001"));
}

TEST_F(EventLogTest, ADamagedHashLogIsRefusedWithItsLineAndKept)
{
  const std::string path = (folder_ / "hashes.txt").string();
  for (const char* line :
       {"4x 0000000000000004\n", "7 0000000000000004\n", "4 000000000000004\n", "4 000000000000000z\n", "\n"})
  {
    const std::string text = std::string("3 0000000000000003\n") + line + "5 0000000000000005\n";
    folder_.Write("hashes.txt", text);
    EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { HashLog log(path, 6); }),
                HasSubstr("hashes.txt:2: the hash log is damaged"));
    EXPECT_EQ(test::TextOf(path), text);
  }
}

}  // namespace
}  // namespace swarmanoid
