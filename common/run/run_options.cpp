#include "common/run/run_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

// The limits are those of the elements of the experiment file.
constexpr double kMostTicks = 1e15;
constexpr double kFastest = 1e6;
// The limits are those of the processes of a cluster (BusOptionTable).
constexpr double kShortestLease_s = 0.2;
constexpr double kLongestLease_s = 3600;
constexpr double kShortestStep_s = 1e-3;
constexpr double kLongestStep_s = 1e6;

// The programs that take a setting. Each program takes the settings of those before it too.
enum class For
{
  kLauncher,
  kServer,
  kChoice  // every program that reads the experiment
};

struct RunOption : OptionSpec
{
  For program = For::kLauncher;
};

std::string PairMistake(const std::string& text, const std::string& form, bool value_needed)
{
  const std::size_t sign = text.find('=');
  const bool good = sign != std::string::npos && sign > 0 && (!value_needed || sign + 1 < text.size());
  return good ? "" : "write " + form;
}

std::string SettingMistake(const std::string& text) { return PairMistake(text, "PATH=VALUE", false); }
std::string EngineHostMistake(const std::string& text) { return PairMistake(text, "ENGINE=HOST", true); }

std::string HashMistake(const std::string& text)
{
  const bool good =
      !text.empty() && text.size() <= 16 && text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  return good ? "" : "it must be up to 16 hexadecimal digits";
}

// Reads "2GiB", "500M" or "1073741824"; units are powers of 1024. Returns nullopt for any other text, and for sizes
// that no memory has.
std::optional<std::uint64_t> SizeOf(const std::string& text)
{
  constexpr double kMostBytes = 1e15;
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = ParseNumber(text.substr(0, end));
  if (!number) return std::nullopt;
  std::string unit = text.substr(end);
  double factor = 1;
  if (!unit.empty() && unit != "B")
  {
    const std::size_t power = std::string_view("KMGT").find(unit[0]);
    const std::string rest = unit.substr(1);
    if (power == std::string_view::npos || (!rest.empty() && rest != "B" && rest != "iB")) return std::nullopt;
    factor = std::exp2(10.0 * static_cast<double>(power + 1));
  }
  const double bytes = *number * factor;
  if (!(bytes >= 1) || bytes > kMostBytes) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

std::string SizeMistake(const std::string& text)
{
  return SizeOf(text) ? "" : "write a number of bytes, or one with KiB, MiB, GiB or TiB";
}

std::string MemoryLimitMistake(const std::string& text)
{
  constexpr std::uint64_t kLeastBytes = 64U << 20U;  // no process of a run starts with less memory
  const auto bytes = SizeOf(text);
  if (bytes && *bytes < kLeastBytes) return "a process of a run does not start with less than 64MiB";
  return SizeMistake(text);
}

// 0 means the default. Values between 0 and the limit are refused here, before a process refuses them.
std::string LeaseMistake(const std::string& text)
{
  const double lease_s = ParseNumber(text).value_or(0);
  return lease_s == 0 || lease_s >= kShortestLease_s
             ? ""
             : fmt::format("it must be 0, or from {:g} to {:g} s", kShortestLease_s, kLongestLease_s);
}

// Steps are timed in milliseconds, so a shorter limit would mean none.
std::string StepTimeoutMistake(const std::string& text)
{
  const double step_s = ParseNumber(text).value_or(0);
  return step_s == 0 || step_s >= kShortestStep_s
             ? ""
             : fmt::format("it must be 0, or from {:g} to {:g} s", kShortestStep_s, kLongestStep_s);
}

std::string BranchMistake(const std::string& text)
{
  const std::size_t sign = text.rfind('@');
  const bool good = sign != std::string::npos && sign > 0 && sign + 1 < text.size() && text.size() - sign <= 17 &&
                    text.find_first_not_of("0123456789", sign + 1) == std::string::npos;
  return good ? "" : "write the folder of a run and one of its ticks, RUN@TICK";
}

std::vector<RunOption> Table(RunSettings& s)
{
  OptionSpec file{Path("EXPERIMENT", "The experiment file"), &s.file, "configs/diffusion_10.xml"};
  file.required = true;
  std::vector<RunOption> table{
      {file, For::kChoice},
      {{Whole("seed", "Seed of all random numbers, instead of the file's", 0, kLargestSeed), &s.seed, "7"},
       For::kChoice},
      {{Whole("ticks", "Ticks to run, instead of the file's maxclock; 0: until stopped", 0, kMostTicks), &s.ticks,
        "1000"},
       For::kChoice},
      {{Text("set", "Change the experiment: another value for an element or attribute of the file"), &s.settings,
        "arena.fb.position=1,2,0", "PATH=VALUE", SettingMistake},
       For::kChoice},
      {{Text("show",
             "Add a visualisation to those of the file, such as web or opengl, which may steer the run; its parameters "
             "may follow in the same word"),
        &s.show, "'image video=film.webm'", "KIND"},
       For::kLauncher},
      {{Path("output",
             "Folder of the run; `swarmanoid run` takes a new or empty one, otherwise runs/<experiment>-<time>"),
        &s.output_folder, "results/first"},
       For::kServer},
      {{Number("real-time", "", "Run at this multiple of real time; 0: as fast as possible", 0, kFastest),
        &s.real_time_factor, "2"},
       For::kServer},
      {{Flag("paused",
             "Start paused, until somebody resumes: in a window or page, or a cluster by `swarmanoid control resume`"),
        &s.paused},
       For::kServer},
      {{Flag("single-process", "Run everything in this process, without DDS"), &s.single_process}, For::kLauncher},
      {{Whole("threads",
              "Threads of a controller host, which share its sensors and the controllers that may step in parallel; 0: "
              "one in "
              "a cluster, in one process as many as cores are free",
              0, 64),
        &s.threads, "2"},
       For::kLauncher},
      {{Whole("controller-hosts", "Processes that share the robots' controllers", 1, 1000), &s.controller_hosts, "2"},
       For::kServer},
      {{Flag("no-visualisers", "Leave out the <visualisations> of the file"), &s.visualisations}, For::kChoice},
      {{Flag("quiet", "Show no progress"), &s.quiet}, For::kLauncher},
  };
  const auto add = [&table](const char* group, const std::vector<RunOption>& options)
  {
    for (RunOption option : options)
    {
      option.group = group;
      table.push_back(std::move(option));
    }
  };
  add("Repeat and compare",
      {
          {{Path("hash-log", "File that gets the hash of the state at every tick"), &s.hash_log, "hashes.txt"},
           For::kServer},
          {{Text("expect-hash", "Exit with 5 unless the run ends with this hash"), &s.expected_hash, "bfe0390c84c85930",
            "HASH", HashMistake},
           For::kLauncher},
          {{Path("events", "events.csv of an earlier run: its moves and its end by a user are repeated"), &s.events,
            "runs/first/events.csv", "", FileMistake},
           For::kServer},
          {{Path(
                "faults-of",
                "Folder of an earlier run: its controllers fail again where they did, and no time is measured till its "
                "end"),
            &s.faults_of, "runs/first"},
           For::kServer},
          {{Text("branch",
                 "Begin as an earlier run was at that tick, with the changes of --set, --seed and --ticks; without "
                 "EXPERIMENT the run's own"),
            &s.branch, "runs/first@500", "RUN@TICK", BranchMistake},
           For::kLauncher},
          {{Whole("ahead",
                  "Ticks from a control step to the one in which its commands act, instead of the file's; 1 lets "
                  "controllers and engines of a cluster work at the same time",
                  0, 1),
            &s.ahead, "1"},
           For::kChoice},
      });
  add("Checkpoints, journal and recovery",
      {
          {{Whole("checkpoint-every",
                  "Write the whole state to checkpoint-<tick> in the folder of the run every so many ticks; 0: never",
                  0, kMostTicks),
            &s.checkpoint_every, "500"},
           For::kServer},
          {{Path("restore", "Go on from a checkpoint of the same experiment and seed"), &s.restore_file,
            "first/checkpoint-00000500", "", FileMistake},
           For::kServer},
          {{Flag("any-build",
                 "Restore what another build of Swarmanoid or of a library saved, without the promise of equal bits"),
            &s.any_build},
           For::kServer},
          {{Flag("no-journal", "Keep no journal; a process that dies then is not replaced"), &s.journal}, For::kServer},
          {{{.name = "journal",
             .type = kChoice,
             .description = "What comes of a run whose journal cannot be written any more; needed: it ends",
             .choices = {"needed", "optional"}},
            &s.journal_need,
            "optional"},
           For::kServer},
          {{Text(
                "journal-budget",
                "Keep the newest of the journal: its oldest part is deleted once it is longer, and all processes saved "
                "their states since"),
            &s.journal_budget, "2GiB", "SIZE", SizeMistake},
           For::kServer},
          {{Flag("no-recovery", "End the run when one of its processes dies"), &s.recovery}, For::kLauncher},
          {{Whole("retries", "How often a process that dies is replaced without a tick between; 0: never", 0, 1000),
            &s.retries, "10"},
           For::kLauncher},
      });
  add("Limits",
      {
          {{Number("step-timeout", "s",
                   "Time that one step of a controller, engine, functions, device or renderer may take; 0: any", 0,
                   kLongestStep_s),
            &s.step_timeout_s, "5", "", StepTimeoutMistake},
           For::kLauncher},
          {{Text("memory-limit", "Memory that each process may take; otherwise nine tenths of what this machine has"),
            &s.memory_limit, "2GiB", "SIZE", MemoryLimitMistake},
           For::kLauncher},
          {{Number("lease", "s",
                   "Silence after which a process counts as dead, 0.2 or more; 0: one on this machine is waited for", 0,
                   kLongestLease_s),
            &s.lease_s, "5", "", LeaseMistake},
           For::kLauncher},
      });
  add("Machines and networks",
      {
          {{Text("engine-host", "Run an engine on another machine"), &s.engine_hosts, "ground=alpha", "ENGINE=HOST",
            EngineHostMistake},
           For::kLauncher},
          {{Path("hosts", "File that says which process runs on which machine (docs/command.md)"), &s.hosts_file,
            "hosts.txt", "", FileMistake},
           For::kLauncher},
          {{{.name = "placement",
             .type = kChoice,
             .description = "Processor cores of the processes; auto: one core where the experiment is small",
             .choices = {"auto", "one-core", "spread"}},
            &s.placement},
           For::kLauncher},
          {{Whole("domain", "DDS domain, otherwise a free one", 0, 232), &s.domain, "7"}, For::kLauncher},
          {{Path("key",
                 "File with the key of the run, for processes of other machines (docs/security.md); otherwise a new "
                 "one"),
            &s.key_file, "run.key", "", FileMistake},
           For::kLauncher},
          {{Flag("insecure",
                 "Without a key: every program in the domain may take part, watch and steer (docs/security.md)"),
            &s.insecure},
           For::kLauncher},
          {{Flag("isolated",
                 "In a network of its own: no program but yours can reach the run, and it can reach none "
                 "(docs/security.md)"),
            &s.isolated},
           For::kLauncher},
          {{Flag("ros2", "Show the run to ROS 2 (docs/ros2.md): the same as --show ros2"), &s.ros2}, For::kLauncher},
      });
  return table;
}

std::vector<OptionSpec> OptionsFor(For program, RunSettings& settings)
{
  std::vector<OptionSpec> options;
  for (const RunOption& option : Table(settings))
    if (option.program >= program) options.push_back(option);
  return options;
}

}  // namespace

std::vector<OptionSpec> RunOptionTable(RunSettings& settings) { return OptionsFor(For::kLauncher, settings); }
std::vector<OptionSpec> ServerOptionTable(RunSettings& settings) { return OptionsFor(For::kServer, settings); }
std::vector<OptionSpec> ChoiceOptionTable(RunSettings& settings) { return OptionsFor(For::kChoice, settings); }

std::vector<std::string> ServerWords(const RunSettings& settings)
{
  RunSettings absolute = settings;
  const std::vector<OptionSpec> options = ServerOptionTable(absolute);
  for (const OptionSpec& option : options)
    if (auto* const* path = std::get_if<std::string*>(&option.target); path != nullptr && !(*path)->empty())
      if (option.value.type == kPath) **path = std::filesystem::absolute(**path).lexically_normal();
  RunSettings untouched;
  return WordsOf(options, ServerOptionTable(untouched));
}

std::uint64_t SimulatorOptions::JournalBudgetBytes() const { return SizeOf(journal_budget).value_or(0); }

Limits LimitsOf(const RunSettings& settings)
{
  Limits limits = LimitsOfEnvironment();
  if (settings.step_timeout_s > 0) limits.step_s = settings.step_timeout_s;
  if (const auto bytes = SizeOf(settings.memory_limit)) limits.memory_bytes = *bytes;
  return limits;
}

std::pair<std::string, std::string> SplitSetting(const std::string& text)
{
  if (const std::string mistake = SettingMistake(text); !mistake.empty())
    throw UsageError(fmt::format("--set is {}; {}; for example --set framework.maxclock=100", Quoted(text), mistake));
  const std::size_t sign = text.find('=');
  return {text.substr(0, sign), text.substr(sign + 1)};
}

LoadOptions ChangesOf(const ExperimentChoice& choice)
{
  LoadOptions changes;
  for (const std::string& setting : choice.settings) changes.settings.push_back(SplitSetting(setting));
  const auto add = [&](const char* option, const char* path, const std::optional<std::uint64_t>& value)
  {
    if (!value) return;
    for (const auto& [set, given] : changes.settings)
      if (set == path)
        throw UsageError(fmt::format("--{} {} and --set {}={} set the same value; leave one of the two out", option,
                                     *value, set, given));
    changes.settings.emplace_back(path, std::to_string(*value));
  };
  add("seed", "framework.seed", choice.seed);
  add("ticks", "framework.maxclock", choice.ticks);
  add("ahead", "framework.ahead", choice.ahead);
  return changes;
}

}  // namespace swarmanoid
