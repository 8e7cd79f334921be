// The `swarmanoid` command: runs experiments, and everything around them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "common/configuration/wording.h"
#include "launcher/commands.h"
#include "launcher/exit_codes.h"
#include "launcher/unexpected_words.h"

namespace
{

const std::vector<std::string> kVerbs{"run", "attach", "control", "check", "list", "new"};

// CLI11 would only say that the word was not expected.
bool ComplainsAboutVerb(int count, char** arguments)
{
  if (count < 2 || arguments[1][0] == '-') return false;
  const std::string verb = arguments[1];
  if (std::find(kVerbs.begin(), kVerbs.end(), verb) != kVerbs.end()) return false;
  fmt::print(stderr, "swarmanoid: there is no command {}; the commands are {}{}\n", swarmanoid::Quoted(verb),
             swarmanoid::Listed(kVerbs), swarmanoid::DidYouMean(verb, kVerbs));
  return true;
}

}  // namespace

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  if (ComplainsAboutVerb(count, arguments)) return kUsage;
  CLI::App app("Runs swarm-robotics experiments, and looks at those that run.", "swarmanoid");
  app.set_version_flag("--version", "swarmanoid " SWARMANOID_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* failed, const CLI::Error& error)
                      { return fmt::format("swarmanoid: {}\n", CommandLineComplaint(*failed, error)); });
  app.footer(
      "Start with:\n  swarmanoid run configs/diffusion_10.xml\n`swarmanoid COMMAND --help` explains a command with "
      "examples.");

  int exit_code = kDone;
  AddRunCommand(app, exit_code);
  AddAttachCommand(app, exit_code);
  AddControlCommand(app, exit_code);
  AddCheckCommand(app, exit_code);
  AddListCommand(app, exit_code);
  AddNewCommand(app, exit_code);

  try
  {
    app.parse(count, arguments);
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  catch (const UsageError& error)
  {
    fmt::print(stderr, "swarmanoid: {}\n", error.what());
    return kUsage;
  }
  catch (const std::exception& error)
  {
    fmt::print(stderr, "swarmanoid: {}\n", error.what());
    return kProcessFailed;
  }
  return exit_code;
}
