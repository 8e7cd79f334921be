// `swarmanoid share`: lets other users or machines observe or steer a run as non-members, or lets anyone observe it
// with any DDS. It also lists and ends these grants.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/shell_word.h"
#include "common/run/access/access_grant.h"
#include "common/run/access/addresses.h"
#include "common/run/access/cluster_options.h"
#include "common/run/access/run_directory.h"
#include "launcher/command/run_choice.h"
#include "launcher/command/sub_command.h"
#include "launcher/supervision/bus_library.h"
#include "launcher/system/network_namespace.h"

namespace swarmanoid
{
namespace
{

constexpr double kLongestTime_s = 366.0 * 24 * 3600;

struct ShareOptions
{
  std::string experiment;
  bool watch = false;
  bool operate = false;
  bool open = false;
  std::string time;

  bool MakesOne() const { return watch || operate || open; }
  bool list = false;
  std::string revoke;
  bool json = false;
  BusOptions bus;
};

// Reads "90s", "30m", "2h" or "7d". Returns nullopt for any other text.
std::optional<double> SecondsOf(const std::string& text)
{
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string unit(end, text.data() + text.size());
  const double factor = unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : unit == "d" ? 24 * 3600 : 0;
  if (error != std::errc() || factor == 0 || !(number * factor >= 1) || number * factor > kLongestTime_s)
    return std::nullopt;
  return number * factor;
}

RunKey KeyOfChosenRun(const RunChoice& run, const BusOptions& bus)
{
  if (const auto given = GivenKey(bus)) return *given;
  for (const LocalRun& local : FindLocalRuns())
    if (local.experiment == run.experiment && local.domain == run.domain && local.key) return *local.key;
  throw UsageError(fmt::format(
      "no run of experiment {} in domain {} on this machine is of user {} and has a key, and none is given by "
      "--key; members of a run alone can share it",
      Quoted(run.experiment), run.domain, UserName()));
}

void PrintToken(const AccessToken& token, bool json)
{
  const AccessGrant& grant = token.grant;
  const std::string variable = fmt::format("{}={}", kTokenVariable, ShellWord(TextOf(token)));
  const std::string line = variable + " swarmanoid attach web";
  if (json)
  {
    const nlohmann::ordered_json text{{"id", grant.id},
                                      {"role", RoleName(grant.role)},
                                      {"ends", grant.ends},
                                      {"ticket", TextOf(token)},
                                      {"line", line}};
    fmt::print("{}\n", text.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  fmt::print("{}\n", line);
  PrintError("{}: all who have this line may {}{}, {}. `swarmanoid share {} --revoke {}` ends it.\n", grant.Name(),
             grant.role == GrantRole::kOperator ? "look at the run and steer it" : "look at the run",
             token.address.starts_with("127.") ? ", as any user of this machine (the run uses no network)" : "",
             grant.ends == 0 ? "as long as it runs" : "until " + UtcText(grant.ends), ShellWord(token.experiment),
             grant.id);
}

void PrintOpenView(const AccessGrant& grant, const RunChoice& run, const std::string& address, bool json)
{
  std::vector<std::string> topics;
  for (const char* topic : {"View", "RunStatus", "World", "Leave"})
    topics.push_back(fmt::format("{}/{}", topic, kOpenChannel));
  if (json)
  {
    const nlohmann::ordered_json text{{"id", grant.id},       {"role", RoleName(grant.role)}, {"ends", grant.ends},
                                      {"domain", run.domain}, {"partition", run.experiment},  {"topics", topics},
                                      {"address", address}};
    fmt::print("{}\n", text.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    return;
  }
  fmt::print("DDS domain {}, partition {}, topics {}\n", run.domain, run.experiment, fmt::join(topics, " "));
  fmt::print(stderr,
             "{}: all who reach {} may look at the run with any DDS, {}. Nothing of it is encrypted. `swarmanoid share "
             "{} --revoke {}` ends it.\n",
             grant.Name(), address, grant.ends == 0 ? "as long as it runs" : "until " + UtcText(grant.ends),
             ShellWord(run.experiment), grant.id);
}

int ShareRun(ShareOptions& options, bool domain_given)
{
  const int asked = (options.watch ? 1 : 0) + (options.operate ? 1 : 0) + (options.open ? 1 : 0) +
                    (options.list ? 1 : 0) + (options.revoke.empty() ? 0 : 1);
  if (asked != 1) throw UsageError("give one of --watch, --operate, --open, --list and --revoke ID");
  const auto seconds = SecondsOf(options.time);
  if (!options.time.empty() && !seconds)
    throw UsageError(
        fmt::format("--for {}: it must be a time up to 366 days, such as 90s, 30m, 2h or 7d", options.time));
  if (!options.time.empty() && !options.MakesOne())
    throw UsageError("--for is the time of --watch, --operate or --open");

  const RunChoice run = ChooseRun(options.experiment, domain_given ? std::optional(options.bus.domain) : std::nullopt);
  options.bus.domain = run.domain;
  if (run.server && run.network == RunNetwork{} && IsInAnotherNetwork(*run.server) && options.MakesOne())
    throw UsageError(fmt::format("{} runs in a network of its own (--isolated), which only its user can reach",
                                 Quoted(run.experiment)));
  UseNetworkOf(run, options.bus);
  const RunKey key = KeyOfChosenRun(run, options.bus);
  options.bus.key = key;

  const GrantRole role = options.operate ? GrantRole::kOperator
                         : options.open  ? GrantRole::kOpenView
                                         : GrantRole::kWatcher;
  AccessGrant grant{NewGrantId(), role, 0};
  if (seconds)
    grant.ends = static_cast<std::int64_t>(std::time(nullptr)) + static_cast<std::int64_t>(std::ceil(*seconds));
  ControlOrder order{"share", {{"grant", grant.id}, {"role", RoleWord(grant.role)}, {"ends", grant.ends}}};
  if (options.list) order = {"shares"};
  if (!options.revoke.empty()) order = {"revoke", {{"grant", options.revoke}}};

  const BusLibrary& bus = LoadBusLibrary();
  const auto reply = bus.Ask(options.bus, "swarmanoid share", run.experiment, order, kPatience_s).reply;
  if (!reply)
  {
    PrintError("swarmanoid: experiment {} in domain {} does not answer\n", Quoted(run.experiment), run.domain);
    return kExitProcessFailed;
  }
  if (!reply->ok)
  {
    PrintError("swarmanoid: {}\n", reply->text);
    return kExitUsage;
  }
  if (options.list)
    fmt::print("{}", reply->text.empty() ? "" : reply->text + "\n");
  else if (!options.revoke.empty())
    fmt::print("{}\n", reply->text);
  else if (const std::string address = reply->text.substr(reply->text.rfind(' ') + 1); options.open)
    PrintOpenView(grant, run, address, options.json);
  else
  {
    AccessToken token{grant, run.domain, address, {}, {}, run.experiment};
    if (const auto server = ParseServerAddress(token.address))
    {
      token.discovery_server = token.address;
      token.address = server->first;
    }
    token.key = bus.ChannelOf(key, grant).key.value();
    PrintToken(token, options.json);
  }
  return kExitDone;
}

void AddShareCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ShareOptions>();
  CLI::App* verb = app.add_subcommand("share", "Let others look at a running experiment, or steer it");
  verb->add_option("EXPERIMENT", options->experiment, "Its name (may be left out where one runs)");
  verb->add_flag("--watch", options->watch, "Print a line for somebody who may look at the run");
  verb->add_flag("--operate", options->operate, "Print a line for somebody who may look at it and steer it");
  verb->add_flag("--open", options->open,
                 "Let all who reach the run look at it, not encrypted, with any program of DDS (docs/wire.md)");
  verb->add_option("--for", options->time,
                   "How long that is good, such as 90s, 30m, 2h or 7d; otherwise as long as the run")
      ->type_name("TIME");
  verb->add_flag("--list", options->list, "List the access grants of the run");
  verb->add_option("--revoke", options->revoke, "End the access grant of that id at once")->type_name("ID");
  verb->add_flag("--json", options->json,
                 "With --watch and --operate, for programs: id, role, ends, ticket and line; with --open also domain, "
                 "partition, topics and address");
  AddOptions(*verb, BusOptionTable(options->bus));
  verb->footer(
      "The line is pasted at another machine that reaches this one, or given to another user of this machine. It holds "
      "a "
      "key: send it as you would a password. A run that uses no network can be shared on its own machine alone; "
      "`options = --interface eth0` in the file of `swarmanoid run --hosts` lets it use one.\n"
      "Examples:\n"
      "  swarmanoid share --watch                      a line to look at the experiment that runs on this machine\n"
      "  swarmanoid share diffusion_10 --operate --for 2h\n"
      "  swarmanoid share --open                       for programs of your own that know DDS\n"
      "  swarmanoid share --list\n"
      "  swarmanoid share --revoke 1a2b3c4d\n"
      "In the line, other commands can take the place of `attach web`:\n"
      "  SWARMANOID_SHARE=... swarmanoid attach text\n"
      "  SWARMANOID_SHARE=... swarmanoid control pause");
  verb->callback([options, verb, &exit_code]
                 { exit_code = ShareRun(*options, verb->get_option("--domain")->count() > 0); });
}

const RegisterSubCommand kShare(11, "share", AddShareCommand);

}  // namespace
}  // namespace swarmanoid
