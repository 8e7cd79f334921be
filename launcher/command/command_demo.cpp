// `swarmanoid demo`: plays the sample experiments.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/shell_word.h"
#include "launcher/command/sub_command.h"
#include "launcher/showing.h"
#include "launcher/system/installation.h"
#include "simulation/load.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

struct DemoOptions
{
  std::string name = "prey_retrieval";
  bool list = false;
  bool page = false;
  bool film = false;
  std::string output;
};

// The first line of the comment that the file begins with if that is a sentence, otherwise its first sentence.
std::string FirstSentence(const fs::path& file)
{
  std::ifstream stream(file);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  const std::size_t start = text.find("<!--");
  const std::size_t end = text.find("-->");
  if (start == std::string::npos || end == std::string::npos) return {};
  const std::string line(TrimBlanks(text.substr(start + 4, std::min(text.find('\n', start), end) - start - 4)));
  if (line.ends_with('.')) return line.substr(0, line.size() - 1);
  std::string words;
  for (const char c : text.substr(start + 4, end - start - 4))
    if (const bool blank = c == ' ' || c == '\n'; !blank || (!words.empty() && words.back() != ' '))
      words += blank ? ' ' : c;
  // A dot before a small letter or a digit ends no sentence, as in "et al. 2014".
  std::size_t stop = words.find(". ");
  while (stop != std::string::npos && stop + 2 < words.size() && (words[stop + 2] < 'A' || words[stop + 2] > 'Z'))
    stop = words.find(". ", stop + 2);
  return std::string(TrimBlanks(words.substr(0, stop)));
}

// The samples that show most come first, the others follow by name.
int List()
{
  std::vector<std::string> names = SampleNames();
  auto next = names.begin();
  for (const char* first : {"prey_retrieval", "aggregation", "convoy", "prey_supply", "sound_seekers", "kilobots",
                            "handbot_shelf", "three_engines", "rough_terrain", "stones", "crowd_in_regions"})
    if (const auto found = std::find(next, names.end(), first); found != names.end())
    {
      std::rotate(next, found, found + 1);
      ++next;
    }
  for (const std::string& name : names) fmt::print("{:<24} {}\n", name, FirstSentence(SampleFile(name)));
  return kExitDone;
}

int Play(const DemoOptions& options)
{
  const std::vector<std::string> names = SampleNames();
  if (std::ranges::find(names, options.name) == names.end())
    throw UsageError(fmt::format("there is no sample {}; `swarmanoid demo --list` names them{}", Quoted(options.name),
                                 DidYouMean(options.name, names)));
  if (options.page && options.film) throw UsageError("give --page or --film, not both");
  const std::string file = SampleFile(options.name);
  const auto experiment = LoadOrComplain(file, {});
  if (!experiment) return kExitInvalidFile;
  PrintError("{}: {}\n", options.name, FirstSentence(file));
  ShowingKind kind = options.page ? ShowingKind::kPage : options.film ? ShowingKind::kFilm : KindForSession();
  if (kind == ShowingKind::kPage && !options.page) kind = ShowingKind::kOpenedPage;
  try
  {
    const RunFolder folder(options.output, "demo_" + options.name);
    const int exit_code = Show(*experiment, kind, folder.Path());
    std::error_code none;
    fs::remove(folder.Path(), none);  // empty after a page
    if (exit_code != kExitDone) return exit_code;
  }
  catch (const RunFolderError& error)
  {
    throw UsageError(error.what());
  }
  PrintError("Next: swarmanoid run {}\n", ShellWord(ShortPath(file)));
  return kExitDone;
}

void AddDemoCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<DemoOptions>();
  CLI::App* verb = app.add_subcommand(
      "demo", "Play a sample: on a page in the browser, or without a display as a picture and a film");
  verb->add_option("NAME", options->name, "The sample")->capture_default_str();
  verb->add_flag("--list", options->list, "List the samples");
  verb->add_flag("--page", options->page, "Play it in real time on a page, and only tell its address");
  verb->add_flag("--film", options->film, "Draw a picture and a film");
  verb->add_option("--output", options->output, "Folder of picture and film; otherwise runs/demo_<name>-<time>")
      ->type_name("FILE");
  verb->footer(
      "Examples:\n"
      "  swarmanoid demo\n"
      "  swarmanoid demo --list\n"
      "  swarmanoid demo rough_terrain --film");
  verb->callback([options, &exit_code] { exit_code = options->list ? List() : Play(*options); });
}

const RegisterSubCommand kDemo(19, "demo", AddDemoCommand);

}  // namespace
}  // namespace swarmanoid
