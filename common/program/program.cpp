#include "common/program/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <string_view>
#include <system_error>

#include "common/activity/failure_report.h"
#include "common/configuration/configuration_tree.h"
#include "common/configuration/shown_text.h"
#include "common/errors/print_error.h"
#include "common/limits/limits.h"
#include "common/program/colour.h"
#include "common/program/command_line_complaint.h"
#include "common/program/empty_words.h"
#include "common/program/help_text.h"
#include "common/program/interrupts.h"
#include "common/program/man_page.h"
#include "common/program/standard_output.h"
#include "common/program/usage_error.h"
#include "common/version/version.h"

namespace swarmanoid
{
namespace
{

std::string terminating_program;

void Complain(const std::string& program, std::string_view what)
{
  // Only the colour may have escape sequences.
  std::fputs((Coloured(STDERR_FILENO, Colour::kRed, program) + Showable(fmt::format(": {}\n", what))).c_str(), stderr);
}

// Prints the exception being handled, and returns its exit code.
int Report(const std::string& program)
{
  try
  {
    throw;
  }
  catch (const UsageError& error)
  {
    Complain(program, error.what());
    return kExitUsage;
  }
  catch (const ConfigurationError& error)
  {
    NoteEnd(EndReason::kInvalid, 0, error.what(), true);
    // If the error has a file, its position comes first, as editors expect it.
    if (error.Location().file)
      PrintError("{}\n", error.what());
    else
      Complain(program, error.what());
    return kExitInvalidFile;
  }
  catch (const std::exception& error)
  {
    // Printing throws this if standard output is full or closed. The message must then say so.
    const auto* const of_system = dynamic_cast<const std::system_error*>(&error);
    if (of_system != nullptr) errno = of_system->code().value();
    if (of_system != nullptr && std::ferror(stdout) != 0 && errno == EPIPE)
    {
      ReaderOfOutputHasGone();
      return kExitDone;
    }
    if (of_system != nullptr && !OutputIsWritten()) return kExitProcessFailed;
    NoteEnd(Interrupted() ? EndReason::kInterrupted : EndReason::kFailed, 0, error.what(), true);
    Complain(program, error.what());
  }
  catch (...)
  {
    Complain(program, "something was thrown that is no std::exception");
  }
  return Interrupted() ? kExitInterrupted : kExitProcessFailed;
}

std::string VersionText(const std::string& program)
{
  const std::string revision = GitRevision();
  return fmt::format("{} {}{}", program, Version(), revision.empty() ? "" : " (" + revision + ")");
}

// Handles an exception that left a thread or a destructor. Nothing can be tidied up any more.
[[noreturn]] void Terminate()
{
  int code = kExitProcessFailed;
  if (std::current_exception())
    code = Report(terminating_program);
  else
    PrintError("{}: std::terminate was called\n", terminating_program);
  LeaveAtOnce(code == kExitInterrupted ? code : kExitProcessFailed);
}

}  // namespace

namespace
{

int RunWithoutOutput(const ProgramDescription& program, int count, char** arguments,
                     const std::function<void(CLI::App&)>& declare, const std::function<int()>& run)
{
  terminating_program = program.name;
  std::set_terminate(Terminate);
  CLI::App app(program.purpose, program.name);
  app.failure_message([&](const CLI::App* failed, const CLI::Error& error)
                      { return fmt::format("{}: {}\n", program.name, CommandLineComplaint(*failed, error)); });
  app.footer(program.footer);
  app.formatter(MakeHelpFormatter());
  try
  {
    if (program.register_plugins != nullptr) program.register_plugins();
    declare(app);
    RefuseEmptyWords(app);
    app.set_version_flag("--version", VersionText(program.name), "Print version and commit, then end");
    if (count == 3 && std::string_view(arguments[1]) == kManPagesFlag)
    {
      WriteManPages(app, arguments[2]);
      return kExitDone;
    }
    app.parse(count, arguments);
    if (program.catches_interrupts) CatchInterrupts();
    if (program.runs_code_of_users)
    {
      ReportDeaths(program.name);
      ApplyLimits(LimitsOfEnvironment());
    }
    return run();
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  catch (...)
  {
    return Report(program.name);
  }
}

}  // namespace

int RunProgram(const ProgramDescription& program, int count, char** arguments,
               const std::function<void(CLI::App&)>& declare, const std::function<int()>& run)
{
  OpenStandardFiles();
  const int code = RunWithoutOutput(program, count, arguments, declare, run);
  // The output of users' code is no result, so a log that could not be written does not fail the run.
  return program.runs_code_of_users ? code : ExitCodeWithOutput(code);
}

}  // namespace swarmanoid
