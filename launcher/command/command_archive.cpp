// `swarmanoid archive`: puts a run and all that is needed to repeat it into one file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/interrupts.h"
#include "common/program/shell_word.h"
#include "launcher/archive/make_archive.h"
#include "launcher/command/sub_command.h"

namespace swarmanoid
{
namespace
{

// Says what is in the archive and what is not.
void PrintContent(const MadeArchive& made)
{
  std::vector<std::string> files, libraries;
  for (const ArchiveMember& member : made.index.members)
    if (member.name.starts_with("files/")) files.push_back(member.name.substr(sizeof "files/" - 1));
  for (const LibraryBuild& build : made.index.builds)
    if (build.name.ends_with(".so")) libraries.push_back(fmt::format("{} (build-id {})", build.name, build.build));
  if (!files.empty()) PrintError("with the files of the experiment: {}\n", Listed(files));
  if (!libraries.empty()) PrintError("without the libraries, which it names: {}\n", Listed(libraries));
  if (!made.index.has_ended)
    PrintError("note: the run was killed or still goes on; its hashes end at tick {}\n", made.index.last_tick);
}

int Archive(const ArchiveRequest& request)
{
  CatchInterrupts();
  const MadeArchive made = MakeArchive(request);
  if (made.path.empty()) return kExitInterrupted;
  PrintContent(made);
  fmt::print("archived: {}, {} bytes, {} hashes, SHA-256 {}\n", made.path, made.bytes, made.hashes, made.digest);
  PrintError("Next: swarmanoid reproduce {}\n", ShellWord(made.path));
  return kExitDone;
}

void AddArchiveCommand(CLI::App& app, int& exit_code)
{
  auto request = std::make_shared<ArchiveRequest>();
  CLI::App* verb = app.add_subcommand("archive", "Put a run into one file that reproduces it, for a paper");
  verb->add_option("RUN", request->run, "The folder of a run")->required();
  verb->add_option("--output", request->output, "The new file; otherwise <folder of the run>.tar.gz here")
      ->type_name("FILE");
  verb->add_flag("--journal", request->journal, "With the journal, so that the unpacked folder can be replayed");
  verb->add_flag("--page", request->page, "With page.html, which plays the run in any browser; it needs a journal");
  verb->add_option("--file", request->files, "Another file that code of the experiment reads; again for each other one")
      ->type_name("FILE");
  verb->footer(
      "The file has the experiment, the files that it names, the seed, versions and builds, requests of users, and the "
      "hash of each tick if the run kept a journal or a --hash-log, otherwise of its end and its checkpoints. "
      "Libraries "
      "of controllers are named with their builds, and are not in it.\n"
      "Examples:\n"
      "  swarmanoid archive runs/latest\n"
      "  swarmanoid archive runs/latest --journal --page --output figure_3.tar.gz\n"
      "  swarmanoid reproduce figure_3.tar.gz");
  verb->callback([request, &exit_code] { exit_code = Archive(*request); });
}

const RegisterSubCommand kArchive(7, "archive", AddArchiveCommand);

}  // namespace
}  // namespace swarmanoid
