// `swarmanoid plot` draws pictures of a study, by a script with matplotlib.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "common/errors/exit_codes.h"
#include "common/program/option_parser.h"
#include "common/program/spawn.h"
#include "common/program/usage_error.h"
#include "launcher/command/sub_command.h"
#include "launcher/system/installation.h"
#include "studies/tables/study_store.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

struct PlotOptions
{
  std::string study;
  std::vector<std::string> metrics;
  std::vector<std::string> comparisons;
  std::string reference;
  std::string format = "svg";
  std::string ended = "stop";
  std::string output;
};

std::vector<OptionSpec> PlotOptionTable(PlotOptions& o)
{
  OptionSpec study{Path("STUDY", "The folder of a study"), &o.study, "results/aggregation"};
  study.required = true;
  return {
      study,
      {Text("metric", "A column of the table, again for each other one; otherwise all"), &o.metrics, "dispersion"},
      {Text("compare", "Compare two values of a factor in pairs of runs, by Wilcoxon's test; again for each other one"),
       &o.comparisons, "controller=walk,search", "FACTOR=A,B"},
      {Path("reference", "A JSON file with curves of others, which are drawn beside those of the study"), &o.reference,
       "configs/studies/aggregation_reference.json"},
      {{.name = "format", .type = kChoice, .description = "Of the picture files", .choices = {"svg", "png"}},
       &o.format,
       "png"},
      {{.name = "ended",
        .type = kChoice,
        .description = "Over time, a run that ends stops the line of its mean, or keeps its last value",
        .choices = {"stop", "hold"}},
       &o.ended,
       "hold"},
      {Path("output", "Folder of the pictures; otherwise pictures/ in that of the study"), &o.output, "figures"},
  };
}

int Run(const std::vector<std::string>& words)
{
  const pid_t process =
      Spawn({.words = words, .input = STDIN_FILENO, .output = STDOUT_FILENO, .errors = STDERR_FILENO});
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kExitProcessFailed;
}

bool CanDraw(const std::string& python)
{
  try
  {
    return Run({python, "-c",
                "import importlib.util as u, sys; sys.exit(None in map(u.find_spec, ('matplotlib', 'scipy')))"}) == 0;
  }
  catch (const std::runtime_error&)
  {
    return false;  // the program does not exist
  }
}

int Plot(const PlotOptions& options)
{
  try
  {
    StudyStore::RequireWhole(options.study);
  }
  catch (const StudyStoreError& error)
  {
    throw UsageError(error.what());
  }
  // The first Python on the path may not be Debian's.
  std::string python;
  for (const char* candidate : {"python3", "/usr/bin/python3"})
    if (python.empty() && CanDraw(candidate)) python = candidate;
  if (python.empty())
    throw UsageError(
        "plot: pictures are drawn by matplotlib and scipy, which are not both here; as root: apt-get install "
        "python3-matplotlib python3-scipy");
  const std::string script =
      (std::filesystem::path(UserFilesFolder()).parent_path() / "studies" / "plot_study.py").string();
  // The form --name=value allows values that begin with a dash.
  std::vector<std::string> words{python, "-B", script, "--format=" + options.format, "--ended=" + options.ended};
  for (const std::string& metric : options.metrics) words.push_back("--metric=" + metric);
  for (const std::string& request : options.comparisons) words.push_back("--compare=" + request);
  if (!options.reference.empty()) words.push_back("--reference=" + options.reference);
  if (!options.output.empty()) words.push_back("--output=" + options.output);
  words.insert(words.end(), {"--", options.study});
  return Run(words);
}

void AddPlotCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<PlotOptions>();
  CLI::App* verb = app.add_subcommand("plot", "Draw pictures of a study, and a report with all of them");
  AddOptions(*verb, PlotOptionTable(*options));
  verb->footer(
      "It needs python3-matplotlib and python3-scipy. A study that goes on can be drawn, too.\n"
      "Examples:\n"
      "  swarmanoid plot results/aggregation\n"
      "  swarmanoid plot results/aggregation --metric dispersion --format png --output figures");
  verb->callback([options, &exit_code] { exit_code = Plot(*options); });
}

const RegisterSubCommand kPlot(22, "plot", AddPlotCommand);

}  // namespace
}  // namespace swarmanoid
