// `swarmanoid sweep` runs a study.
#include <CLI/CLI.hpp>
#include <memory>

#include "common/program/empty_words.h"
#include "common/program/option_parser.h"
#include "common/program/trust_flag.h"
#include "launcher/command/sub_command.h"
#include "studies/sweep.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

std::vector<OptionSpec> SweepOptionTable(SweepOptions& o)
{
  OptionSpec study{Path("STUDY", "The study file; with --resume the folder of a study"), &o.study,
                   "configs/studies/aggregation.xml"};
  study.required = true;
  return {
      study,
      {Path("output", "Folder of the study, new or empty; otherwise runs/<study>-<time>"), &o.output,
       "results/aggregation"},
      {Flag("resume", "Go on with a study that was interrupted: STUDY is its folder"), &o.resume},
      {Flag("dry-run", "List the runs, estimate their time and disk space, and run none"), &o.dry_run},
      {Text("only", "Run only what fulfils a condition over the factors and seed; the others wait for --resume"),
       &o.only, "'robots <= 20 and seed < 5'", "CONDITION"},
      {Text("until-ci",
            "Give each point more seeds until the confidence interval of 95 % of a column's mean at the end of the "
            "runs is within so many percent of it"),
       &o.until_ci, "dispersion=5%", "COLUMN=PERCENT"},
      {Whole("most-seeds", "Of a point, for --until-ci", 2, 1'000'000), &o.most_seeds, "100"},
      {Path("hosts", "Run on other machines, by ssh: the line `runs` of the file names them"), &o.hosts, "hosts.txt"},
      {Text("slurm", "Run as job arrays of Slurm, with these options of sbatch; '' for none"), &o.slurm,
       "'--partition=short --time=10'", "OPTIONS"},
      {Whole("runs-per-task", "Of a task of --slurm; 0: so many that there are 200 tasks at most", 0, 1'000'000),
       &o.runs_per_task, "20"},
      {Whole("jobs", "Runs at a time, or tasks of --slurm; 0: as many as cores, one cluster, or as Slurm starts", 0,
             10'000),
       &o.jobs, "2"},
      {Whole("retries", "How often a run that fails is run again", 0, 1000), &o.retries, "1"},
      {Flag("quiet", "No progress"), &o.quiet},
  };
}

void AddSweepCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<SweepOptions>();
  CLI::App* verb = app.add_subcommand("sweep", "Run a study: an experiment with many parameters and seeds");
  AddOptions(*verb, SweepOptionTable(*options));
  AllowEmpty(*verb->get_option("--slurm"));
  AddTrustFlag(*verb);
  verb->footer(
      "The last line on standard output is\n"
      "  finished: <runs> runs, <failed> failed, <wall> s, table <folder>/table.csv\n"
      "Ctrl-C once ends the study after the runs that go on (jobs of Slurm are cancelled), twice kills them; --resume\n"
      "goes on.\n"
      "Exit codes: 0 done, 2 usage, 3 the study or its experiment is invalid, 4 some runs failed, 9 --until-ci\n"
      "was not reached with --most-seeds, 130 interrupted.\n"
      "Examples:\n"
      "  swarmanoid sweep configs/studies/aggregation.xml --dry-run\n"
      "  swarmanoid sweep configs/studies/aggregation.xml --output results/aggregation\n"
      "  swarmanoid sweep results/aggregation --resume --retries 1\n"
      "  swarmanoid sweep configs/studies/coverage_search.xml --output results/coverage\n"
      "  echo 'runs = alpha beta here' >hosts.txt\n"
      "  swarmanoid sweep configs/studies/aggregation.xml --hosts hosts.txt\n"
      "  swarmanoid sweep configs/studies/aggregation.xml --slurm '--partition=short --time=10' --runs-per-task 20");
  verb->callback([options, &exit_code] { exit_code = Sweep(*options); });
}

const RegisterSubCommand kSweep(21, "sweep", AddSweepCommand);

}  // namespace
}  // namespace swarmanoid
