#include "common/logging/log.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <stdexcept>

#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

class LogTest : public ::testing::Test
{
protected:
  ~LogTest() override
  {
    OpenLog({.process = "test"});  // closes the file
  }
  std::string FileText() const { return folder_.Read("worker.log"); }

  test::TemporaryFolder folder_;
};

TEST_F(LogTest, TheFileHoldsEveryRecordAtOnceAndStandardErrorTheSeriousOnes)
{
  testing::internal::CaptureStderr();
  OpenLog({.process = "worker", .folder = folder_.Path()});
  LogDebug("not asked for");
  LogInfo("tick {}", 7);
  LogWarning("braces {} in a text stay", "{}");
  LogError("the end");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "worker: warning: braces {} in a text stay\nworker: error: the end\n");
  const std::string text = FileText();
  EXPECT_THAT(text, testing::HasSubstr(" info: tick 7\n"));
  EXPECT_THAT(text, testing::HasSubstr(" warning: braces {} in a text stay\n"));
  EXPECT_THAT(text, testing::HasSubstr(" error: the end\n"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("not asked for")));
}

TEST_F(LogTest, WhatControllersLogMovesNoCursor)
{
  testing::internal::CaptureStderr();
  OpenLog({.process = "worker", .folder = folder_.Path()});
  LogWarning("sees \x1b[2J a wall");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "worker: warning: sees ?[2J a wall\n");
  EXPECT_THAT(FileText(), testing::HasSubstr(" warning: sees ?[2J a wall\n"));
}

TEST_F(LogTest, OpeningAgainGoesOnInTheSameFile)
{
  OpenLog({.process = "worker", .folder = folder_.Path()});
  LogInfo("first");
  OpenLog({.process = "worker", .folder = folder_.Path()});
  LogInfo("second");
  EXPECT_THAT(FileText(), testing::AllOf(testing::HasSubstr("first"), testing::HasSubstr("second")));
}

TEST_F(LogTest, AFileThatCannotBeWrittenIsNamedWithTheCause)
{
  const std::string missing = (folder_ / "nowhere").string();
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { OpenLog({.process = "worker", .folder = missing}); }),
            "cannot write the log " + missing + "/worker.log: No such file or directory");
}

}  // namespace
}  // namespace swarmanoid
