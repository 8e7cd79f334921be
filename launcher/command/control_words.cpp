#include "launcher/command/control_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/configuration/wording.h"
#include "common/messages/control_verbs.h"
#include "common/program/shell_word.h"
#include "launcher/command/sub_command.h"

namespace swarmanoid
{
namespace
{

constexpr double kPatienceWithMoves_s = 600;

const ControlVerb* FindVerb(const std::string& word) { return FindControlVerb(word, Asker::kMember); }

bool TakesAName(const ControlVerb& verb)
{
  return !verb.parameters.empty() && verb.parameters.front().type == ArgumentType::kName;
}

// Returns whether the first word is the name of an experiment. An experiment may be called like a verb, and then a verb
// follows it. An entity may be called like a verb, too, and then a verb is before it.
bool NamesAnExperiment(const std::vector<std::string>& words)
{
  if (words.size() < 2) return false;
  const ControlVerb* const first = FindVerb(words[0]);
  if (FindVerb(words[1]) != nullptr) return first == nullptr || !TakesAName(*first);
  if (first != nullptr) return false;
  // Neither is a verb: the first one may be a misspelt verb.
  const std::vector<std::string> verbs = ControlVerbNames(Asker::kMember);
  return NearestName(words[0], verbs).empty() || !NearestName(words[1], verbs).empty();
}

}  // namespace

ControlWords ParseControlWords(std::vector<std::string> words, const std::map<std::string, std::string>& options)
{
  ControlWords control;
  if (NamesAnExperiment(words))
  {
    control.experiment = words[0];
    words.erase(words.begin());
  }
  const std::string name = words.empty() ? "" : words[0];
  const ControlVerb* const verb = FindVerb(name);
  if (verb == nullptr) throw UsageError("control: " + NoVerbText(name, Asker::kMember));
  try
  {
    control.order = ParseOrder(*verb, options, {words.begin() + 1, words.end()});
  }
  catch (const std::invalid_argument& error)
  {
    std::string text = error.what();
    if (verb->parameters.empty() && words.size() == 2)
      text += fmt::format("; if it is the name of an experiment: swarmanoid control {1} {0}", words[0],
                          ShellWord(words[1]));
    throw UsageError(text);
  }
  return control;
}

double PatienceFor(const ControlOrder& order, double otherwise_s)
{
  const bool moves = FindControlVerb(order.verb)->effect == Effect::kPlacement;
  return moves ? std::max(otherwise_s, kPatienceWithMoves_s) : otherwise_s;
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
