// The frame around every program: which exit code an end has. Launcher and scripts tell ends apart by it.
#include "common/program/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include "common/activity/exit_codes.h"
#include "common/configuration/configuration_tree.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

int CodeOf(const std::function<int()>& run, std::vector<std::string> arguments = {})
{
  ProgramDescription program{};
  program.name = "program_test";
  arguments.insert(arguments.begin(), program.name);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  return RunProgram(
      program, static_cast<int>(pointers.size()), pointers.data(), [](CLI::App&) {}, run);
}

TEST(Program, ItsExitCodeTellsHowItEnded)
{
  EXPECT_EQ(CodeOf([] { return 0; }), 0);
  EXPECT_EQ(CodeOf([] { return 1; }), 1);
  EXPECT_EQ(CodeOf([]() -> int { throw UsageError("no such option"); }), 2);
  EXPECT_EQ(CodeOf([] { return 0; }, {"--no-such-option"}), 2);
  EXPECT_EQ(CodeOf([]() -> int { throw ConfigurationError({}, "no such engine"); }), 3);
  EXPECT_EQ(CodeOf([]() -> int { throw std::runtime_error("out of paper"); }), 4);
  EXPECT_EQ(CodeOf([]() -> int { throw 5; }), 4);
}

// As after a connection by ssh has broken: nothing that is written arrives.
TEST(Program, EndsInOrderIfNobodyReadsItsErrors)
{
  const int errors = dup(STDERR_FILENO);
  const int full = open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  dup2(full, STDERR_FILENO);
  int code = -1;
  EXPECT_NO_THROW(code = CodeOf([]() -> int { throw std::runtime_error("out of paper"); }));
  dup2(errors, STDERR_FILENO);
  close(errors);
  close(full);
  EXPECT_EQ(code, 4);
}

}  // namespace
}  // namespace swarmanoid
