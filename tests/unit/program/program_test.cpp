// The exit codes of programs, by which the launcher and scripts distinguish ends.
#include "common/program/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "common/configuration/configuration_tree.h"
#include "common/errors/exit_codes.h"
#include "common/program/help_text.h"
#include "common/program/option_parser.h"
#include "common/program/standard_output.h"
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

// Nothing that is written arrives, as after a broken connection by ssh.
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

// The exit code of a program after `prepare` has changed its standard files.
int CodeWithOutput(const std::function<void()>& prepare, const std::function<int()>& run)
{
  std::fflush(stdout);
  prepare();
  return CodeOf(run);
}

TEST(ProgramDeathTest, FailsIfItsResultCannotBeWritten)
{
  const auto print = []
  {
    std::fputs("the result\n", stdout);
    return 0;
  };
  const auto is_full = [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); };
  const auto is_closed = [] { close(STDOUT_FILENO); };
  const auto ends_with_4 = testing::ExitedWithCode(4);
  EXPECT_EXIT(std::exit(CodeWithOutput(is_full, print)), ends_with_4, "standard output: No space left on device");
  EXPECT_EXIT(std::exit(CodeWithOutput(is_closed, print)), ends_with_4, "standard output: Bad file descriptor");
  EXPECT_EXIT(std::exit(CodeWithOutput(is_full, [] { return 0; })), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(std::exit(CodeWithOutput(is_full,
                                       [&]
                                       {
                                         print();
                                         return 5;
                                       })),
              testing::ExitedWithCode(5), "standard output");
  // More than is kept before it is written: printing itself fails.
  EXPECT_EXIT(std::exit(CodeWithOutput(is_full,
                                       []
                                       {
                                         for (int k = 0; k < 100000; ++k) fmt::print("a long result\n");
                                         return 0;
                                       })),
              ends_with_4, "standard output: No space left on device");
}

// The next file that is opened must not become its standard output.
TEST(ProgramDeathTest, OpensNoFileInThePlaceOfItsOutput)
{
  const auto opened = []
  {
    const int file = open("/dev/null", O_WRONLY);
    return file > STDERR_FILENO ? 0 : 1;
  };
  EXPECT_EXIT(std::exit(CodeWithOutput(
                  []
                  {
                    close(STDIN_FILENO);
                    close(STDOUT_FILENO);
                  },
                  opened)),
              testing::ExitedWithCode(0), "");
}

TEST(TerminalWidth, IsKnownOfATerminalThatTellsIt)
{
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  winsize size{};
  ASSERT_EQ(ioctl(terminal, TIOCSWINSZ, &size), 0);
  EXPECT_FALSE(TerminalWidth(terminal));
  size.ws_col = 97;
  ASSERT_EQ(ioctl(terminal, TIOCSWINSZ, &size), 0);
  EXPECT_EQ(TerminalWidth(terminal).value_or(0), 97U);
  close(terminal);
  const int file = open("/dev/null", O_RDONLY);
  EXPECT_FALSE(TerminalWidth(file));
  close(file);
}

TEST(Help, LinesAreBrokenAtBlanksAndNoWordIsLost)
{
  EXPECT_EQ(Wrapped("", 10), "");
  EXPECT_EQ(Wrapped("one two three", 20), "one two three");
  EXPECT_EQ(Wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(Wrapped("one two three", 8), "one two\nthree");
  EXPECT_EQ(Wrapped("alongword two", 4), "alongword\ntwo");
  EXPECT_EQ(Wrapped("  an example that is not broken\nbut this", 5), "  an example that is not broken\nbut\nthis");
}

std::string HelpOf(const std::function<void(CLI::App&)>& declare)
{
  CLI::App app("Tries something", "trial");
  app.formatter(MakeHelpFormatter());
  declare(app);
  return app.help();
}

TEST(Help, PurposeUsageAndExamplesComeFirstAndOptionsStandInGroups)
{
  std::string file, log;
  unsigned tries = 3;
  const std::string help = HelpOf(
      [&](CLI::App& app)
      {
        OptionSpec place{{.name = "FILE", .type = ParameterType::kPath, .description = "What is tried"}, &file, "a"};
        place.required = true;
        OptionSpec rare{{.name = "log", .type = ParameterType::kPath, .description = "Where it is written"}, &log, "b"};
        rare.group = "Rare";
        AddOptions(
            app,
            {place, {{.name = "tries", .type = ParameterType::kInteger, .description = "How often"}, &tries}, rare});
        app.footer("It ends by itself.\nExamples:\n  trial first");
      });
  EXPECT_EQ(help,
            "Tries something.\n\nUsage: trial FILE [OPTIONS]\n\nExamples:\n  trial first\n\n"
            "Arguments:\n  FILE                     What is tried\n\n"
            "Options:\n  -h --help                Print this help message and exit\n"
            "  --tries N                How often [3]\n\n"
            "Rare:\n  --log FILE               Where it is written, for example --log b\n\nIt ends by itself.\n");
}

}  // namespace
}  // namespace swarmanoid
