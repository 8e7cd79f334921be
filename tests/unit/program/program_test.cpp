// The exit codes of programs, by which the launcher and scripts distinguish ends.
#include "common/program/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "common/configuration/configuration_tree.h"
#include "common/errors/exit_codes.h"
#include "common/program/colour.h"
#include "common/program/command_line_complaint.h"
#include "common/program/empty_words.h"
#include "common/program/help_text.h"
#include "common/program/man_page.h"
#include "common/program/option_parser.h"
#include "common/program/standard_output.h"
#include "common/program/usage_error.h"
#include "tests/world/temporary_folder.h"

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

TEST(Help, ExamplesStandBehindTheNotes)
{
  using Parts = std::pair<std::string, std::string>;
  EXPECT_EQ(SplitFooter("A note.\nExamples:\n  trial a\n"), Parts("A note.\n", "  trial a\n"));
  EXPECT_EQ(SplitFooter("Example:\n  trial a"), Parts("", "  trial a"));
  EXPECT_EQ(SplitFooter("A note."), Parts("A note.", ""));
}

// Returns what a program says of these words; empty if it takes them.
std::string ComplaintOf(std::vector<std::string> words, const std::function<void(CLI::App&)>& declare)
{
  CLI::App app("Tries something", "trial");
  declare(app);
  std::reverse(words.begin(), words.end());  // the order in which CLI11 takes them
  try
  {
    app.parse(std::move(words));
  }
  catch (const CLI::Error& error)
  {
    return CommandLineComplaint(app, error);
  }
  return "";
}

TEST(CommandLineComplaint, NamesTheWordAndWhatIsTakenInstead)
{
  std::string file, output;
  const auto says = [&](const std::vector<std::string>& words)
  {
    return ComplaintOf(words,
                       [&](CLI::App& app)
                       {
                         app.add_option("FILE", file, "What is tried")->required();
                         app.add_option("--output", output, "Where it is written");
                         app.add_option("--only", output, "What is written");
                         app.footer("Examples:\n  trial first    tries it\n  trial second");
                       });
  };
  EXPECT_EQ(says({"a", "--output", "b"}), "");
  EXPECT_EQ(says({"a", "--outptu", "b"}),
            "trial does not take '--outptu'; did you mean '--output'? All options: trial --help");
  EXPECT_EQ(says({"a", "--outptu=b"}),
            "trial does not take '--outptu'; did you mean '--output'? All options: trial --help");
  EXPECT_EQ(says({"a", "-o", "b"}),
            "trial does not take '-o'; its options with that letter: --output, --only. All options: trial --help");
  EXPECT_EQ(says({"a", "--different"}), "trial does not take '--different'. All options: trial --help");
  EXPECT_EQ(says({"a", "b"}), "trial does not take 'b'; it takes FILE. All options: trial --help");
  EXPECT_EQ(says({}), "trial needs FILE: What is tried; for example: trial first");
}

TEST(CommandLineComplaint, NamesTheCommands)
{
  const auto says = [&](const std::vector<std::string>& words)
  {
    return ComplaintOf(words,
                       [](CLI::App& app)
                       {
                         app.require_subcommand(1);
                         app.add_subcommand("run", "Runs it");
                         app.add_subcommand("check", "Checks it");
                       });
  };
  EXPECT_EQ(says({"run"}), "");
  EXPECT_EQ(says({}), "trial needs one of: run, check");
  EXPECT_EQ(says({"chek"}), "trial has no 'chek'; it has: run, check; did you mean 'check'?");
  EXPECT_EQ(says({"run", "--fast"}), "trial run does not take '--fast'. All options: trial run --help");
}

TEST(EmptyWords, AreRefusedUnlessTheOptionAllowsThem)
{
  const auto parse = [](const std::string& word, bool may_be_empty, bool in_command = false)
  {
    std::string value;
    CLI::App app("", "trial");
    CLI::App* const command = in_command ? app.add_subcommand("run") : &app;
    CLI::Option* const option = command->add_option("--log", value);
    if (may_be_empty) AllowEmpty(*option);
    RefuseEmptyWords(app);
    std::vector<std::string> words{word, "--log"};
    if (in_command) words.emplace_back("run");
    app.parse(words);
    return value;
  };
  EXPECT_EQ(parse("a", false), "a");
  EXPECT_EQ(parse("", true), "");
  EXPECT_THROW(parse("", false), UsageError);
  EXPECT_THROW(parse("", false, true), UsageError);
  try
  {
    parse("", false);
  }
  catch (const UsageError& error)
  {
    EXPECT_STREQ(error.what(), "--log is empty; give it a value, or leave it out");
  }
}

TEST(ManPages, AreOfTheProgramAndOfEachCommand)
{
  const test::TemporaryFolder folder;
  CLI::App app("Tries something", "trial");
  unsigned tries = 3;
  CLI::App* const run = app.add_subcommand("run", "Runs it");
  run->add_option("FILE", tries, "What is run")->required();
  run->add_option("--tries", tries, "How often")->type_name("N")->default_str("3");
  run->footer("It ends by itself.\nExamples:\n  trial run a-b");
  WriteManPages(app, folder.Path());
  const std::string program = folder.Read("trial.1"), command = folder.Read("trial-run.1");
  EXPECT_EQ(program.substr(0, program.find(" \"\"")), ".TH TRIAL 1");
  for (const char* part :
       {".SH NAME\ntrial \\- Tries something\n", ".SH SYNOPSIS\n.B trial\n.I COMMAND\n.RI [ options ]\n",
        ".SH COMMANDS\n.TP\n.B run\nRuns it\n", ".SH SEE ALSO\n.BR trial\\-run (1),\n"})
    EXPECT_NE(program.find(part), std::string::npos) << part;
  for (const char* part : {".TH TRIAL-RUN 1", ".SH NAME\ntrial\\-run \\- Runs it\n",
                           ".SH SYNOPSIS\n.B trial run\n.I FILE\n.RI [ options ]\n", ".SH DESCRIPTION\nRuns it.\n",
                           ".TP\n.B \\-\\-tries \\fIN\\fR\nHow often.\nDefault: 3.\n", ".TP\n.B FILE\nWhat is run.\n",
                           ".SH NOTES\n.nf\nIt ends by itself.\n.fi\n", ".SH EXAMPLES\n.nf\n  trial run a\\-b\n.fi\n",
                           ".SH SEE ALSO\n.BR trial (1),\n"})
    EXPECT_NE(command.find(part), std::string::npos) << part << "in\n" << command;
  EXPECT_THROW(WriteManPages(app, folder / "missing"), std::runtime_error);
}

TEST(Coloured, IsForTerminalsThatAreNotRefusedColours)
{
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  EXPECT_EQ(Coloured(terminal, Colour::kRed, "a"), "\033[31ma\033[0m");
  EXPECT_EQ(Coloured(terminal, Colour::kGreen, "a"), "\033[32ma\033[0m");
  EXPECT_EQ(Coloured(terminal, Colour::kYellow, "a"), "\033[33ma\033[0m");
  setenv("NO_COLOR", "", 1);
  EXPECT_EQ(Coloured(terminal, Colour::kRed, "a"), "\033[31ma\033[0m");
  setenv("NO_COLOR", "1", 1);
  EXPECT_EQ(Coloured(terminal, Colour::kRed, "a"), "a");
  unsetenv("NO_COLOR");
  setenv("TERM", "dumb", 1);
  EXPECT_EQ(Coloured(terminal, Colour::kRed, "a"), "a");
  setenv("TERM", "xterm", 1);
  close(terminal);
  const int file = open("/dev/null", O_WRONLY);
  EXPECT_EQ(Coloured(file, Colour::kRed, "a"), "a");
  close(file);
}

}  // namespace
}  // namespace swarmanoid
