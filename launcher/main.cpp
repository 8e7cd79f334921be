// The `swarmanoid` command: runs experiments, and everything around them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "common/configuration/wording.h"
#include "common/program/program.h"
#include "launcher/commands.h"

namespace
{

const std::vector<std::string> kVerbs{"run", "resume", "attach", "control", "check", "list", "new"};

// CLI11 would only say that the word was not expected.
bool ComplainsAboutVerb(const std::vector<std::string>& words)
{
  if (words.size() < 2 || words[1].starts_with("-")) return false;
  const std::string& verb = words[1];
  if (std::find(kVerbs.begin(), kVerbs.end(), verb) != kVerbs.end()) return false;
  fmt::print(stderr, "swarmanoid: there is no command {}; the commands are {}{}\n", swarmanoid::Quoted(verb),
             swarmanoid::Listed(kVerbs), swarmanoid::DidYouMean(verb, kVerbs));
  return true;
}

// `help` and `help COMMAND` are other ways to write --help; so is no word at all.
std::vector<std::string> WithHelp(std::vector<std::string> words)
{
  if (words.size() == 1) words.emplace_back("help");
  if (words.size() < 2 || words[1] != "help") return words;
  words.erase(words.begin() + 1);
  words.emplace_back("--help");
  return words;
}

}  // namespace

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  std::vector<std::string> words = WithHelp({arguments, arguments + count});
  if (ComplainsAboutVerb(words)) return kExitUsage;
  std::vector<char*> given;
  for (std::string& word : words) given.push_back(word.data());

  int verb_code = kExitDone;
  const int exit_code = RunProgram(
      {.name = "swarmanoid",
       .purpose = "Runs swarm-robotics experiments, and looks at those that run.",
       .footer =
           "Start with:\n  swarmanoid run configs/diffusion_10.xml\n`swarmanoid COMMAND --help` explains a command "
           "with examples.",
       .catches_interrupts = false},
      static_cast<int>(given.size()), given.data(),
      [&](CLI::App& app)
      {
        app.set_version_flag("--version", "swarmanoid " SWARMANOID_VERSION);
        app.require_subcommand(1);
        AddRunCommand(app, verb_code);
        AddResumeCommand(app, verb_code);
        AddAttachCommand(app, verb_code);
        AddControlCommand(app, verb_code);
        AddCheckCommand(app, verb_code);
        AddListCommand(app, verb_code);
        AddNewCommand(app, verb_code);
      },
      [&] { return verb_code; });
  // The help was not asked for.
  return count == 1 && exit_code == kExitDone ? kExitUsage : exit_code;
}
