// `swarmanoid doctor`: checks what runs need on this machine, and says how to mend the rest.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/errors/exit_codes.h"
#include "common/program/colour.h"
#include "launcher/command/doctor.h"
#include "launcher/command/sub_command.h"
#include "launcher/system/scratch_folder.h"

namespace swarmanoid
{
namespace
{

const char* WordFor(Verdict verdict)
{
  return verdict == Verdict::kGood ? "good" : verdict == Verdict::kLimited ? "limited" : "bad";
}

void PrintJson(const std::vector<Finding>& findings)
{
  auto json = nlohmann::ordered_json::array();
  for (const Finding& finding : findings)
    json.push_back({{"subject", finding.subject},
                    {"verdict", WordFor(finding.verdict)},
                    {"what", finding.what},
                    {"cure", finding.cure}});
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void Print(const std::vector<Finding>& findings)
{
  for (const Finding& finding : findings)
  {
    const Colour colour = finding.verdict == Verdict::kGood      ? Colour::kGreen
                          : finding.verdict == Verdict::kLimited ? Colour::kYellow
                                                                 : Colour::kRed;
    fmt::print("{} {:<14} {}\n", Coloured(STDOUT_FILENO, colour, fmt::format("{:<8}", WordFor(finding.verdict))),
               finding.subject, finding.what);
    if (!finding.cure.empty()) fmt::print("{:<23} → {}\n", "", finding.cure);
  }
}

int Doctor(bool json)
{
  const ScratchFolder folder;
  const std::vector<Finding> findings = Examine(folder.Path());
  if (json)
    PrintJson(findings);
  else
    Print(findings);
  for (const Finding& finding : findings)
    if (finding.verdict == Verdict::kBad) return kExitProcessFailed;
  return kExitDone;
}

void AddDoctorCommand(CLI::App& app, int& exit_code)
{
  auto json = std::make_shared<bool>(false);
  CLI::App* verb = app.add_subcommand("doctor", "Try out what runs need of this machine, and say what to do");
  verb->add_flag("--json", *json, "For programs");
  verb->footer(
      "good: it works; limited: runs go, but something else does not; bad: no cluster runs here, exit code 4.\n"
      "Examples:\n"
      "  swarmanoid doctor\n"
      "  swarmanoid doctor --json");
  verb->callback([json, &exit_code] { exit_code = Doctor(*json); });
}

const RegisterSubCommand kDoctor(20, "doctor", AddDoctorCommand);

}  // namespace
}  // namespace swarmanoid
