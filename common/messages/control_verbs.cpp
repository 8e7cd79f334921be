#include "common/messages/control_verbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/shown_text.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kShownBytes = 60;
constexpr double kMostTicks = 1e15;
constexpr double kFastest = 1e9;
constexpr double kLargestSeed = 9e18;
constexpr double kMostHosts = 1000;
constexpr double kFarthestPose = 1e6;  // m, and degrees
constexpr double kLastSecond = 1e12;

// ---- The table. ----

ControlParameter Optional(ControlParameter parameter)
{
  parameter.optional = true;
  return parameter;
}

std::string CheckHosts(const ControlOrder& order)
{
  if (order.Get<std::int64_t>("change", 1) != 0 || order.Find<std::string>("machine") == nullptr) return {};
  return "again takes no machine";
}

std::vector<ControlVerb> MakeVerbs()
{
  using enum ArgumentType;
  const ControlParameter entity{"entity", kName, "ENTITY", "id of an entity"};
  const ControlParameter pose{"pose",       kPose,          "X,Y,Z[,A,B,G]", "place of three or six numbers",
                              "m, degrees", -kFarthestPose, kFarthestPose};
  const ControlParameter key{"key", kName, "KEY", "name of a key"};
  const ControlParameter machine{"machine", kName, "MACHINE", "name of a machine"};
  const ControlParameter grant{"grant", kName, "ID", "id of an access grant"};
  const ControlParameter engine{"engine", kName, "ID", "id of an engine or region"};
  const ControlParameter topic{"topic", kName, "TOPIC", "topic"};
  const ControlParameter fault{"fault", kName, "FAULT", "id of a fault"};
  const ControlParameter ticks{"ticks", kWhole, "N", "number of ticks", "ticks", 1, kMostTicks, true};
  const ControlParameter factor{"factor", kNumber, "F", "multiple of real time", "x", 0, kFastest};
  const ControlParameter seed{"seed", kWhole, "N", "seed of the run that begins", "", 0, kLargestSeed, true, true};
  const ControlParameter host{"host", kWhole, "N", "number of a controller host", "", 0, kMostHosts};
  const ControlParameter change{"change", kChange,     "+N/-N/again", "number of controller hosts more or fewer",
                                "hosts",  -kMostHosts, kMostHosts};
  const ControlParameter role{"role", kChoice, "ROLE", "role", "", 0, 0, false, false, {"watch", "operate", "open"}};
  const ControlParameter ends{"ends", kWhole, "SECOND", "second since 1970, or 0", "s", 0, kLastSecond};

  using enum Effect;
  using enum Asker;
  constexpr AtEnd kRefused = AtEnd::kRefused, kDone = AtEnd::kDone, kCauses = AtEnd::kCauses;
  constexpr bool kAnnounced = true;
  return {
      {"pause", {}, "hold the run before its next tick", kPace, kOperator, kRefused, kAnnounced},
      {"resume", {}, "let the run go on", kPace, kOperator, kDone, kAnnounced},
      {"step", {ticks}, "go on for one tick or N, then pause and answer", kPace, kOperator, kDone},
      {"speed", {factor}, "multiple of real time; 0: as fast as possible", kPace, kOperator, kRefused, kAnnounced},
      {"stop", {}, "end the run at its tick", kEnd, kOperator, kCauses, kAnnounced},
      {"reset", {seed}, "end the run, and begin it again at tick 0", kEnd, kMember, kCauses, kAnnounced},
      {"move", {entity, pose}, "move an entity, with all that hold it or are held by it (m, degrees)", kResult},
      {"detach", {entity, pose}, "end the grips of an entity, and move it alone", kResult},
      {"add", {entity, pose}, "add an entity that was removed, or the next one of the reserve of that id", kResult},
      {"remove", {entity}, "take an entity out of the arena, which ends its grips", kResult},
      {"press", {key}, "press a key, such as I, Up or Space, for experiment functions", kResult},
      {"release", {key}, "release a key, for experiment functions", kResult},
      {"select", {entity}, "select an entity, for experiment functions", kResult},
      {"deselect", {}, "select no entity, for experiment functions", kResult},
      {"move-host",
       {host, Optional(machine)},
       "replace a controller host by another process",
       kPlacement,
       kOperator,
       kRefused,
       kAnnounced},
      {"move-engine",
       {engine, Optional(machine)},
       "replace an engine, or a region ID/N, by another process",
       kPlacement,
       kOperator,
       kRefused,
       kAnnounced},
      {"drain", {machine}, "move all workers of a machine to others", kPlacement, kOperator, kRefused, kAnnounced},
      {"hosts",
       {change, Optional(machine)},
       "start or end controller hosts, or rebalance robots",
       kPlacement,
       kOperator,
       kRefused,
       kAnnounced,
       CheckHosts},
      {"machines", {}, "list the machines of the run and their processes", kQuery},
      {"share", {grant, role, ends}, "let others watch or steer the run", kAccess, kOwner},
      {"shares", {}, "list the access grants of the run", kQuery, kOwner},
      {"revoke", {grant}, "end an access grant", kAccess, kOwner},
      {"refused", {topic}, "a message was refused", kNote, kNobody},
      {"failed", {entity}, "a controller failed, and the run goes on", kNote, kNobody},
      {"fault", {fault}, "a fault of devices began or ended", kNote, kNobody},
  };
}

// ---- Values. ----

std::string NameError(const ControlParameter& parameter, const std::string& name)
{
  const std::string shown = ShowableLine(name, kShownBytes);
  if (name.empty()) return fmt::format("the {} is empty", parameter.name);
  if (name.size() > kLongestName)
    return fmt::format("the {} '{}…' has {} bytes; it must have at most {}", parameter.name, shown, name.size(),
                       kLongestName);
  if (!IsShowableLine(name))
    return fmt::format("the {} '{}' must be one line of UTF-8 text without control characters", parameter.name, shown);
  if (parameter.type == ArgumentType::kChoice && std::ranges::find(parameter.choices, name) == parameter.choices.end())
    return fmt::format("the {} '{}' is none of {}", parameter.name, shown, Listed(parameter.choices));
  return {};
}

std::string NumberError(const ControlParameter& parameter, double number)
{
  if (number >= parameter.minimum && number <= parameter.maximum) return {};
  return fmt::format("{:.15g} is no {} from {:.15g} to {:.15g}", number, parameter.meaning, parameter.minimum,
                     parameter.maximum);
}

std::string ValueError(const ControlParameter& parameter, const ControlValue& value)
{
  // The index of the alternative of ControlValue, by type.
  constexpr std::size_t kIndices[] = {0, 0, 1, 1, 2, 3};
  if (value.index() != kIndices[static_cast<std::size_t>(parameter.type)])
    return fmt::format("the {} is of another type, and no {}", parameter.name, parameter.meaning);
  if (const auto* name = std::get_if<std::string>(&value)) return NameError(parameter, *name);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return NumberError(parameter, static_cast<double>(*whole));
  if (const auto* number = std::get_if<double>(&value)) return NumberError(parameter, *number);
  const auto& pose = std::get<std::vector<double>>(value);
  if (pose.size() != 3 && pose.size() != 6) return fmt::format("{} numbers are no {}", pose.size(), parameter.meaning);
  for (const double number : pose)
    if (const std::string error = NumberError(parameter, number); !error.empty()) return error;
  return {};
}

// Returns nothing if the text is no value of the type; ranges are not looked at.
std::optional<ControlValue> ParseValue(const ControlParameter& parameter, const std::string& text)
{
  const auto value = [](auto parsed)
  { return parsed ? std::optional<ControlValue>(ControlValue(std::move(*parsed))) : std::nullopt; };
  const auto whole = [&](const std::string& digits) -> std::optional<std::int64_t> { return ParseInteger(digits); };
  switch (parameter.type)
  {
    case ArgumentType::kName:
    case ArgumentType::kChoice:
      return text;
    case ArgumentType::kChange:
      if (text == "again") return std::int64_t{0};
      if (text.size() < 2 || (text[0] != '+' && text[0] != '-') || text.find_first_of("123456789") == std::string::npos)
        return std::nullopt;
      return value(whole(text[0] == '+' && text[1] != '-' ? text.substr(1) : text));
    case ArgumentType::kWhole:
      return value(whole(text));
    case ArgumentType::kNumber:
      return value(ParseNumber(text));
    case ArgumentType::kPose:
      return value(ParseNumbers(text));
  }
  return std::nullopt;
}

const ControlParameter* FindParameter(const ControlVerb& verb, std::string_view name)
{
  const auto found = std::ranges::find(verb.parameters, name, &ControlParameter::name);
  return found == verb.parameters.end() ? nullptr : &*found;
}

// Returns the parameter that stands in the column "entity" of an event log; nullptr if the verb has none.
const ControlParameter* NamingParameter(const ControlVerb& verb)
{
  const auto names = [](const ControlParameter& parameter) {
    return parameter.unit.empty() && (parameter.type == ArgumentType::kName || parameter.type == ArgumentType::kWhole);
  };
  const auto found = std::ranges::find_if(verb.parameters, names);
  return found == verb.parameters.end() ? nullptr : &*found;
}

std::vector<std::string> WordsOf(const std::string& text)
{
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(' ', at)) != std::string::npos;)
  {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

}  // namespace

const std::vector<ControlVerb>& ControlVerbs()
{
  static const std::vector<ControlVerb> verbs = MakeVerbs();
  return verbs;
}

const ControlVerb* FindControlVerb(std::string_view name, Asker asker)
{
  const auto found = std::ranges::find(ControlVerbs(), name, &ControlVerb::name);
  return found == ControlVerbs().end() || found->who > asker ? nullptr : &*found;
}

std::vector<std::string> ControlVerbNames(Asker asker)
{
  std::vector<std::string> names;
  for (const ControlVerb& verb : ControlVerbs())
    if (verb.who <= asker) names.push_back(verb.name);
  return names;
}

std::string NoVerbText(const std::string& verb, Asker asker)
{
  const std::vector<std::string> known = ControlVerbNames(asker);
  return fmt::format("there is no request {}; known are {}{}", Quoted(verb), Listed(known), DidYouMean(verb, known));
}

std::string OrderError(const ControlOrder& order, Asker asker)
{
  const ControlVerb* const verb = FindControlVerb(order.verb, asker);
  if (verb == nullptr) return NoVerbText(order.verb, asker);
  const auto refusal = [&](const std::string& why)
  { return fmt::format("{}: {}; write {}", verb->name, why, FormOf(*verb)); };
  for (auto argument = order.arguments.begin(); argument != order.arguments.end(); ++argument)
  {
    const ControlParameter* const parameter = FindParameter(*verb, argument->name);
    if (parameter == nullptr) return refusal("it takes no " + Quoted(argument->name));
    if (std::find_if(order.arguments.begin(), argument,
                     [&](const ControlArgument& other) { return other.name == argument->name; }) != argument)
      return refusal(fmt::format("it has two of {}", Quoted(argument->name)));
    if (const std::string error = ValueError(*parameter, argument->value); !error.empty()) return refusal(error);
  }
  for (const ControlParameter& parameter : verb->parameters)
    if (!parameter.optional &&
        std::ranges::find(order.arguments, parameter.name, &ControlArgument::name) == order.arguments.end())
      return refusal(Quoted(parameter.name) + " is missing");
  const std::string error = verb->check == nullptr ? std::string() : verb->check(order);
  return error.empty() ? error : refusal(error);
}

std::string FormOf(const ControlVerb& verb)
{
  std::string form = verb.name;
  for (const ControlParameter& parameter : verb.parameters)
  {
    const std::string word =
        parameter.is_option ? fmt::format("--{} {}", parameter.name, parameter.form) : parameter.form;
    form += parameter.optional ? fmt::format(" [{}]", word) : " " + word;
  }
  return form;
}

ControlOrder ParseOrder(const ControlVerb& verb, const std::map<std::string, std::string>& named,
                        const std::vector<std::string>& words)
{
  const auto refuse = [&](const std::string& why)
  { throw std::invalid_argument(fmt::format("{}: {}; write {}", verb.name, why, FormOf(verb))); };
  ControlOrder order{verb.name};
  auto word = words.begin();
  for (const ControlParameter& parameter : verb.parameters)
  {
    std::string text;
    if (const auto given = named.find(parameter.name); given != named.end())
      text = given->second;
    else if (word == words.end() || parameter.is_option)
      continue;
    else if (parameter.type == ArgumentType::kPose)
      text = fmt::format("{}", fmt::join(std::exchange(word, words.end()), words.end(), " "));
    else
      text = *word++;
    auto value = ParseValue(parameter, text);
    if (!value) refuse(fmt::format("{} is no {}", Quoted(text), parameter.meaning));
    order.arguments.push_back({parameter.name, std::move(*value)});
  }
  for (const auto& [name, text] : named)
    if (FindParameter(verb, name) == nullptr) refuse("it takes no " + Quoted(name));
  if (word != words.end()) refuse(fmt::format("it takes nothing more, but {} is there", Quoted(*word)));
  if (const std::string error = OrderError(order, Asker::kNobody); !error.empty()) throw std::invalid_argument(error);
  return order;
}

std::string TextOf(const ControlParameter& parameter, const ControlValue& value)
{
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  // The shortest numbers that are read back as the same bits.
  if (const auto* pose = std::get_if<std::vector<double>>(&value)) return fmt::format("{}", fmt::join(*pose, " "));
  const std::int64_t whole = std::get<std::int64_t>(value);
  if (parameter.type != ArgumentType::kChange) return fmt::format("{}", whole);
  return whole == 0 ? "again" : fmt::format("{:+}", whole);
}

std::string TextOf(const ControlOrder& order)
{
  const OrderColumns columns = ColumnsOf(order);
  std::string text = order.verb;
  for (const std::string& column : {columns.entity, columns.numbers})
    if (!column.empty()) text += " " + column;
  return text;
}

OrderColumns ColumnsOf(const ControlOrder& order)
{
  OrderColumns columns;
  const ControlVerb* const verb = FindControlVerb(order.verb, Asker::kNobody);
  if (verb == nullptr) return columns;
  const ControlParameter* const naming = NamingParameter(*verb);
  for (const ControlArgument& argument : order.arguments)
  {
    const ControlParameter* const parameter = FindParameter(*verb, argument.name);
    if (parameter == nullptr) continue;
    const std::string text = TextOf(*parameter, argument.value);
    if (parameter == naming)
      columns.entity = text;
    else
      columns.numbers += (columns.numbers.empty() ? "" : " ") + text;
  }
  return columns;
}

ControlOrder OrderOf(const ControlVerb& verb, const OrderColumns& columns)
{
  std::map<std::string, std::string> named;
  const ControlParameter* const naming = NamingParameter(verb);
  if (!columns.entity.empty()) named[naming == nullptr ? "entity" : naming->name] = columns.entity;
  return ParseOrder(verb, named, WordsOf(columns.numbers));
}

std::string ControlVerbHelp(Asker asker)
{
  constexpr int kColumn = 32;
  std::string text;
  for (const ControlVerb& verb : ControlVerbs())
    if (verb.who <= asker) text += fmt::format("  {:{}}{}\n", FormOf(verb), kColumn, verb.help);
  return text;
}

std::string ControlVerbTable(Asker asker)
{
  std::string text = "| request | meaning |\n|---|---|\n";
  for (const ControlVerb& verb : ControlVerbs())
    if (verb.who <= asker) text += fmt::format("| `{}` | {} |\n", FormOf(verb), verb.help);
  return text;
}

}  // namespace swarmanoid
