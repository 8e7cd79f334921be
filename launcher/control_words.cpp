#include "launcher/control_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/messages/control_request.h"
#include "launcher/command/sub_command.h"

namespace swarmanoid
{
namespace
{

bool IsVerb(const std::string& word)
{
  return std::find(kControlVerbs.begin(), kControlVerbs.end(), word) != kControlVerbs.end();
}

// Of two words that are no verbs: whether the first one is a verb misspelt, rather than an experiment's name.
bool IsMisspelt(const std::string& word, const std::string& next)
{
  return !NearestName(word, kControlVerbs).empty() && NearestName(next, kControlVerbs).empty();
}

double NumberOf(const std::string& text, const std::string& form)
{
  const auto number = ParseNumber(text);
  if (!number) throw UsageError(fmt::format("{} is no number; write {}", Quoted(text), form));
  return *number;
}

void TakeStep(ControlRequest& request, const std::vector<std::string>& rest)
{
  const std::string form = "step or step N, N being 1 or more";
  if (rest.size() > 1) throw UsageError("too many words; write " + form);
  const double ticks = rest.empty() ? 1 : NumberOf(rest[0], form);
  if (ticks < 1 || ticks > 4e9 || ticks != static_cast<double>(static_cast<long long>(ticks)))
    throw UsageError(fmt::format("{} is no number of ticks; write {}", Quoted(rest[0]), form));
  request.numbers = {ticks};
}

void TakeSpeed(ControlRequest& request, const std::vector<std::string>& rest)
{
  const std::string form = "speed F, F being a multiple of real time, or 0 for as fast as possible";
  if (rest.size() != 1) throw UsageError("write " + form);
  request.numbers = {NumberOf(rest[0], form)};
  if (request.numbers[0] < 0) throw UsageError(fmt::format("{} is negative; write {}", Quoted(rest[0]), form));
}

// After "move", "detach" and "add".
void TakePlace(ControlRequest& request, const std::vector<std::string>& rest)
{
  const std::string form = fmt::format("{0} ENTITY X,Y,Z or {0} ENTITY X,Y,Z,ALPHA,BETA,GAMMA", request.verb);
  if (rest.size() < 2) throw UsageError("write " + form);
  request.entity = rest[0];
  std::string numbers;
  for (std::size_t i = 1; i < rest.size(); ++i) numbers += rest[i] + " ";
  const auto values = ParseNumbers(numbers);
  if (!values || (values->size() != 3 && values->size() != 6))
    throw UsageError(
        fmt::format("{} is not a place of three or six numbers; write {}", Quoted(TrimBlanks(numbers)), form));
  request.numbers = *values;
}

void TakeWorker(ControlRequest& request, const std::vector<std::string>& rest)
{
  const char* form = request.verb == "drain"       ? "drain MACHINE"
                     : request.verb == "move-host" ? "move-host N or move-host N MACHINE"
                                                   : "move-engine ID or move-engine ID MACHINE";
  if (rest.empty() || rest.size() > (request.verb == "drain" ? 1U : 2U))
    throw UsageError(fmt::format("write {}", form));
  if (request.verb == "move-host" && !ParseInteger(rest[0]))
    throw UsageError(fmt::format("{} is no number of a controller host; write {}", Quoted(rest[0]), form));
  request.entity = rest.size() == 2 ? rest[0] + " to " + rest[1] : rest[0];
}

void TakeHosts(ControlRequest& request, const std::vector<std::string>& rest)
{
  const std::string form = "hosts +N or hosts -N, or either with a MACHINE, or hosts again";
  if (rest.empty() || rest.size() > 2) throw UsageError("write " + form);
  if (rest[0] == "again")
  {
    if (rest.size() == 2)
      throw UsageError(fmt::format("hosts again takes no machine, but {} is there; write {}", Quoted(rest[1]), form));
    request.numbers = {0};
    return;
  }
  const auto number = ParseInteger(rest[0][0] == '+' ? rest[0].substr(1) : rest[0]);
  if (!number || *number == 0 || (rest[0][0] != '+' && rest[0][0] != '-') || std::abs(*number) > 1000)
    throw UsageError(
        fmt::format("{} says not how many controller hosts more or fewer; write {}", Quoted(rest[0]), form));
  request.numbers = {static_cast<double>(*number)};
  if (rest.size() == 2) request.entity = rest[1];
}

void TakeKey(ControlRequest& request, const std::vector<std::string>& rest)
{
  if (rest.size() != 1) throw UsageError(fmt::format("write {} KEY, such as I, Up or Space", request.verb));
  request.entity = rest[0];
}

void TakeEntity(ControlRequest& request, const std::vector<std::string>& rest)
{
  if (rest.size() != 1) throw UsageError(fmt::format("write {} ENTITY", request.verb));
  request.entity = rest[0];
}

}  // namespace

ControlRequest ParseControlRequest(std::vector<std::string> words, std::optional<std::uint64_t> seed)
{
  ControlRequest request;
  // An experiment may be called like a verb: then a verb follows it.
  if (words.size() > 1 && IsVerb(words[1]) && !IsSpaceChange(words[0]) && !IsInput(words[0]))
  {
    request.experiment = words[0];
    words.erase(words.begin());
  }
  else if (words.size() > 1 && !IsVerb(words[0]) && !IsMisspelt(words[0], words[1]))
  {
    request.experiment = words[0];
    words.erase(words.begin());
  }
  if (words.empty() || !IsVerb(words[0]))
  {
    const std::string word = words.empty() ? "" : words[0];
    throw UsageError(fmt::format("control: there is no {}; write one of {}{}", Quoted(word), Listed(kControlVerbs),
                                 DidYouMean(word, kControlVerbs)));
  }

  request.verb = words[0];
  if (seed && request.verb != "reset")
    throw UsageError(fmt::format("--seed: {} takes none; write reset --seed N", request.verb));
  if (seed) request.entity = std::to_string(*seed);
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (request.verb == "step")
    TakeStep(request, rest);
  else if (request.verb == "speed")
    TakeSpeed(request, rest);
  else if (request.verb == "move" || request.verb == "detach" || request.verb == "add")
    TakePlace(request, rest);
  else if (request.verb == "press" || request.verb == "release")
    TakeKey(request, rest);
  else if (request.verb == "remove" || request.verb == "select")
    TakeEntity(request, rest);
  else if (request.verb == "hosts")
    TakeHosts(request, rest);
  else if (IsWorkerMove(request.verb))
    TakeWorker(request, rest);
  else if (request.verb == "reset" && !rest.empty())
    throw UsageError(
        fmt::format("reset takes nothing after it, but {} is there; write reset or reset --seed N", Quoted(rest[0])));
  else if (!rest.empty())
    throw UsageError(fmt::format("{} takes nothing after it, but {} is there", request.verb, Quoted(rest[0])));
  return request;
}

std::string WhyNoAnswer(const std::optional<RunStatus>& status, std::uint64_t dropped, bool insecure)
{
  if (!status && dropped > 0)
    return insecure ? ", and what it says is not understood without a key; give its --key instead of --insecure"
                    : ", and what it says is not sealed by the key that is used here; give the --key of this run, or "
                      "--insecure if it was started so";
  if (!status) return ", and nothing is heard of it; see the log of its space server";
  std::string text = fmt::format("; it is at tick {}", status->tick);
  const char* before = " and waits for ";
  for (const ProcessStatus& process : status->processes)
  {
    if (process.late_s <= 0) continue;
    text += fmt::format("{}{} since {:.0f} s{}", std::exchange(before, ", "), process.name, process.late_s,
                        process.doing.empty() ? "" : " (" + process.doing + ")");
  }
  return text;
}

}  // namespace swarmanoid
