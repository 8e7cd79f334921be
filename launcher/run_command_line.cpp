#include "launcher/run_command_line.h"

#include <CLI/CLI.hpp>
#include <string>

#include "launcher/load.h"

namespace swarmanoid
{

void AddRunOptions(CLI::App& app, RunOptions& options)
{
  const CLI::Validator hash_digits(
      [](const std::string& text)
      {
        const bool good =
            !text.empty() && text.size() <= 16 && text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
        return good ? std::string() : "'" + text + "' is no hash: write up to 16 hexadecimal digits";
      },
      "HASH");

  app.add_option("EXPERIMENT", options.experiment, "The experiment file")->required();
  app.add_option("--seed", options.seed, "Seed of all random numbers, instead of the file's");
  app.add_option("--ticks", options.ticks, "Ticks to run, instead of the file's maxclock; 0: until stopped");
  app.add_option("--set", options.settings, "PATH=VALUE: change the experiment, for example arena.fb.position=1,2,0")
      ->expected(1)
      ->take_all();
  app.add_option("--output", options.output, "Folder of the run, new or empty (default: runs/<experiment>-<time>)");
  app.add_option("--real-time", options.real_time, "Run at this multiple of real time; 0: as fast as possible")
      ->check(CLI::NonNegativeNumber);
  app.add_flag(
      "--paused", options.paused,
      "Start paused, until somebody resumes: in a window or page, or a cluster by `swarmanoid control resume`");
  app.add_option("--events", options.events,
                 "events.csv of an earlier run: its moves and its end by a user are repeated");
  app.add_flag("--no-visualisers", options.no_visualisers, "Leave out the <visualisations> of the file");
  app.add_option("--hash-log", options.hash_log, "File that gets the hash of the state at every tick");
  app.add_option("--expect-hash", options.expected_hash, "Exit with 5 unless the run ends with this hash")
      ->check(hash_digits);
  app.add_option("--checkpoint-every", options.checkpoint_every,
                 "Write the whole state to checkpoint-<tick> in the folder of the run every so many ticks")
      ->check(CLI::PositiveNumber);
  app.add_option("--restore", options.restore_file, "Go on from a checkpoint of the same experiment and seed")
      ->check(CLI::ExistingFile);
  app.add_flag("--quiet", options.quiet, "Show no progress");
  app.add_option("--step-timeout", options.limits.step_s,
                 "Seconds that one step of a controller, engine, functions, device or renderer may take; 0: any time")
      ->check(CLI::Range(0.0, 1e6));
  app.add_option("--memory-limit", options.limits.memory_bytes,
                 "Memory that each process may take, such as 2GiB (default: nine tenths of what this machine has)")
      ->transform(CLI::AsSizeValue(false));
}

LoadOptions ChangesOf(const RunOptions& options)
{
  LoadOptions changes;
  for (const std::string& setting : options.settings) changes.settings.push_back(SplitSetting(setting));
  if (options.seed) changes.settings.emplace_back("framework.seed", std::to_string(*options.seed));
  if (options.ticks) changes.settings.emplace_back("framework.maxclock", std::to_string(*options.ticks));
  return changes;
}

}  // namespace swarmanoid
