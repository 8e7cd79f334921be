#include "launcher/control_request.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "launcher/commands.h"

namespace swarmanoid
{
namespace
{

const std::vector<std::string> kVerbs{"pause", "resume", "step", "speed", "stop", "move"};

bool IsVerb(const std::string& word) { return std::find(kVerbs.begin(), kVerbs.end(), word) != kVerbs.end(); }

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

void TakeMove(ControlRequest& request, const std::vector<std::string>& rest)
{
  const std::string form = "move ENTITY X,Y,Z or move ENTITY X,Y,Z,ALPHA,BETA,GAMMA";
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

}  // namespace

ControlRequest ParseControlRequest(std::vector<std::string> words)
{
  ControlRequest request;
  // An experiment may be called like a verb: then a verb follows it.
  if (words.size() > 1 && IsVerb(words[1]) && words[0] != "move")
  {
    request.experiment = words[0];
    words.erase(words.begin());
  }
  else if (!words.empty() && !IsVerb(words[0]) && words.size() > 1)
  {
    request.experiment = words[0];
    words.erase(words.begin());
  }
  if (words.empty() || !IsVerb(words[0]))
  {
    const std::string word = words.empty() ? "" : words[0];
    throw UsageError(fmt::format("control: there is no {}; write one of {}{}", Quoted(word), Listed(kVerbs),
                                 DidYouMean(word, kVerbs)));
  }

  request.verb = words[0];
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (request.verb == "step")
    TakeStep(request, rest);
  else if (request.verb == "speed")
    TakeSpeed(request, rest);
  else if (request.verb == "move")
    TakeMove(request, rest);
  else if (!rest.empty())
    throw UsageError(fmt::format("{} takes nothing after it, but {} is there", request.verb, Quoted(rest[0])));
  return request;
}

}  // namespace swarmanoid
