// The messages between a study and the processes that run it elsewhere.
#include <gmock/gmock.h>

#include "common/program/usage_error.h"
#include "studies/executors/checked_frame.h"
#include "studies/executors/slurm.h"
#include "studies/runs/run_files.h"
#include "studies/runs/run_order.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<char> BytesOf(const std::string& text) { return {text.begin(), text.end()}; }

std::string MistakeInFrames(const std::vector<char>& bytes)
{
  FrameReader reader;
  reader.Add(bytes);
  return test::MessageOf<FrameError>(
      [&]
      {
        while (reader.Next()) continue;
      });
}

TEST(CheckedFrame, ArrivesInWhateverPieces)
{
  std::vector<char> bytes = BytesOf("a greeting of the shell\n");
  for (const char* text : {"one", "", "three"})
  {
    const std::vector<char> frame = Framed(BytesOf(text));
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, bytes.size()})
  {
    FrameReader reader;
    std::vector<std::string> got;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
    {
      reader.Add(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
      while (const auto content = reader.Next()) got.emplace_back(content->begin(), content->end());
    }
    EXPECT_THAT(got, ElementsAre("one", "", "three"));
    EXPECT_TRUE(reader.AtEnd());
    EXPECT_EQ(reader.Noise(), "a greeting of the shell\n");
  }
}

TEST(CheckedFrame, NoByteChangesUnseen)
{
  std::vector<char> bytes = Framed(BytesOf("12.5 m"));
  const std::vector<char> second = Framed(BytesOf("13 m"));
  const std::size_t first = bytes.size();
  bytes.insert(bytes.end(), second.begin(), second.end());
  for (std::size_t at = first; at < bytes.size(); ++at)
  {
    std::vector<char> changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    FrameReader reader;
    reader.Add(changed);
    EXPECT_TRUE(reader.Next());
    // Either it is refused, or more is waited for.
    try
    {
      EXPECT_FALSE(reader.Next()) << at;
    }
    catch (const FrameError&)
    {
    }
    EXPECT_FALSE(reader.AtEnd());
  }
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  EXPECT_THAT(MistakeInFrames(bytes), HasSubstr("checksum differs"));
  EXPECT_THAT(MistakeInFrames(BytesOf(std::string(100'000, 'x'))), HasSubstr("is not of a study"));
}

// Orders and results of Slurm stay in files, which a later command reads.
TEST(RunOrders, KeepTheirFormat)
{
  const RunOrder order{{3, 7}, "e.xml", {{"framework.ticks", "9"}}};
  ByteWriter bytes;
  WriteFields(bytes, order);
  ByteWriter expected;
  expected.Put(std::uint32_t{3});
  expected.Put(std::uint64_t{7});
  expected.PutText("e.xml");
  expected.Put(std::uint64_t{1});
  expected.PutText("framework.ticks");
  expected.PutText("9");
  EXPECT_EQ(bytes.Bytes(), expected.Bytes());
  ByteReader reader(bytes.Bytes());
  EXPECT_EQ(ReadFields<RunOrder>(reader).settings, order.settings);
  EXPECT_TRUE(reader.AtEnd());
}

TEST(RunFiles, StayBelowTheirFolder)
{
  for (const char* path : {"../outside", "/etc/outside", "a/../../outside", ""})
  {
    ByteWriter bytes;
    WriteFields(bytes, RunFiles{{{path, {}}}, {}});
    ByteReader reader(bytes.Bytes());
    EXPECT_THROW(RunFiles::Read(reader), std::runtime_error) << path;
  }
}

TEST(SlurmOptions, AreWordsAsOfAShell)
{
  EXPECT_THAT(SlurmOptions(" --partition=short  --comment='two words' -t \"1 0\" ''"),
              ElementsAre("--partition=short", "--comment=two words", "-t", "1 0", ""));
  EXPECT_THAT(SlurmOptions(""), IsEmpty());
  for (const char* own : {"--array=1", "-a1", "--output=x", "-o", "--wrap", "--parsable"})
    EXPECT_THROW(SlurmOptions(own), UsageError) << own;
  EXPECT_THAT(SlurmOptions("--open-mode=append --export=ALL"), ElementsAre("--open-mode=append", "--export=ALL"));
}

}  // namespace
}  // namespace swarmanoid
