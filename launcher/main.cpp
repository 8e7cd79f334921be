// The `swarmanoid` command: runs experiments, and everything around them.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "common/configuration/trust.h"
#include "common/plugins/own_library.h"
#include "common/program/program.h"
#include "launcher/command/completion.h"
#include "launcher/command/sub_command.h"
#include "launcher/system/installation.h"
#include "studies/executors/study_worker.h"
#include "visualiser/robot_playback.h"

namespace
{

// `help` and `help COMMAND` are other ways to write --help; so is no word at all.
std::vector<std::string> WithHelp(std::vector<std::string> words)
{
  if (words.size() == 1) words.emplace_back("help");
  if (words.size() < 2 || words[1] != "help") return words;
  words.erase(words.begin() + 1);
  words.emplace_back("--help");
  return words;
}

// Loads the library of studies, which adds its sub-commands. It needs SQLite, so other sub-commands do without it.
// Returns its function for the processes that execute runs.
decltype(&swarmanoid::RunStudyWorker) LoadStudies()
{
  return reinterpret_cast<decltype(&swarmanoid::RunStudyWorker)>(
      swarmanoid::FunctionOfOwnLibrary("studies", "RunStudyWorker"));
}

// Loads the library of all other sub-commands but `run`, so that a run starts without them. Returns its function that
// completes words.
decltype(&swarmanoid::PrintCompletions) LoadCommands()
{
  return reinterpret_cast<decltype(&swarmanoid::PrintCompletions)>(
      swarmanoid::FunctionOfOwnLibrary("commands", "PrintCompletions"));
}

}  // namespace

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  if (count > 1 && std::string_view(arguments[1]) == kCompleteFlag)
  {
    LoadStudies();
    return LoadCommands()({arguments + 2, arguments + count});
  }
  if (count > 1 && std::string_view(arguments[1]) == kStudyWorkerFlag)
  {
    const bool trusts = count > 2 && std::string_view(arguments[2]) == kTrustFlag;
    if (trusts) TrustExperiments();
    return LoadStudies()({arguments + (trusts ? 3 : 2), arguments + count});
  }
  std::vector<std::string> words = WithHelp({arguments, arguments + count});
  std::vector<char*> given;
  for (std::string& word : words) given.push_back(word.data());

  // The command for renderers, in this process and in those that it starts.
  setenv(kCommandVariable, OwnProgram().c_str(), 1);
  int verb_code = kExitDone;
  const int exit_code = RunProgram(
      {.name = "swarmanoid",
       .purpose = "Runs swarm-robotics experiments, and looks at those that run.",
       .footer = "`swarmanoid COMMAND --help` explains a command, with examples.\n"
                 "Examples:\n"
                 "  swarmanoid demo\n"
                 "  swarmanoid run configs/diffusion_10.xml",
       .catches_interrupts = false},
      static_cast<int>(given.size()), given.data(),
      [&](CLI::App& app)
      {
        const std::string word = words.size() > 1 ? words[1] : "";
        if (!IsSubCommand(word)) LoadCommands();
        if (!IsSubCommand(word)) LoadStudies();
        AddSubCommands(app, verb_code, word);
      },
      [&] { return verb_code; });
  // Without arguments the help is printed, although the user did not ask for it.
  return count == 1 && exit_code == kExitDone ? kExitUsage : exit_code;
}
