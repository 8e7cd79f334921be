#include "common/logging/log.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

class LogTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    folder_ = std::filesystem::temp_directory_path() / fmt::format("swarmanoid_log_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override
  {
    OpenLog({.process = "test"});  // closes the file
    std::filesystem::remove_all(folder_);
  }
  std::string FileText() const
  {
    std::ifstream file(folder_ / "worker.log");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
};

TEST_F(LogTest, TheFileHoldsEveryRecordAtOnceAndStandardErrorTheSeriousOnes)
{
  testing::internal::CaptureStderr();
  OpenLog({.process = "worker", .folder = folder_.string()});
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
  OpenLog({.process = "worker", .folder = folder_.string()});
  LogWarning("sees \x1b[2J a wall");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "worker: warning: sees ?[2J a wall\n");
  EXPECT_THAT(FileText(), testing::HasSubstr(" warning: sees ?[2J a wall\n"));
}

TEST_F(LogTest, OpeningAgainGoesOnInTheSameFile)
{
  OpenLog({.process = "worker", .folder = folder_.string()});
  LogInfo("first");
  OpenLog({.process = "worker", .folder = folder_.string()});
  LogInfo("second");
  EXPECT_THAT(FileText(), testing::AllOf(testing::HasSubstr("first"), testing::HasSubstr("second")));
}

TEST_F(LogTest, AFileThatCannotBeWrittenIsNamedWithTheCause)
{
  const std::string missing = (folder_ / "nowhere").string();
  try
  {
    OpenLog({.process = "worker", .folder = missing});
    FAIL() << "opened a log in a folder that does not exist";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_EQ(std::string(error.what()), "cannot write the log " + missing + "/worker.log: No such file or directory");
  }
}

}  // namespace
}  // namespace swarmanoid
