// The verbs of control requests as one table. Words of a command line, JSON of a page, methods in Python, lines of the
// event log, checks, completion, help and the reference page all follow from its rows. A new verb is one row here and
// one action: in space_server/run_control.cpp, or in space_server/cluster/access_grants.cpp for access grants.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "idl/control_request_message.h"

namespace swarmanoid
{

enum class ArgumentType
{
  kName,    // one line of text, not empty
  kChoice,  // one of the words in `choices`
  kWhole,   // an integer
  kChange,  // an integer that is written with its sign; 0 is written "again"
  kNumber,  // a finite number
  kPose     // three or six numbers; as words they are the last argument
};

struct ControlParameter
{
  std::string name;
  ArgumentType type = ArgumentType::kName;
  std::string form;     // as help texts show it: "N"
  std::string meaning;  // what it is, after "the": "number of a controller host"
  std::string unit{};   // without a unit, an integer is the name of something
  double minimum = 0;
  double maximum = 0;
  bool optional = false;
  bool is_option = false;  // a command line gives it as --name
  std::vector<std::string> choices{};
};

// Each group may send the requests of the groups before it too.
enum class Asker
{
  kOperator,  // holders of operator grants
  kMember,    // members of the run, and the pages and windows of members
  kOwner,     // members of the run, by a sub-command of its own
  kNobody     // lines of the event log that are no requests
};

enum class Effect
{
  kPace,       // when ticks are computed
  kEnd,        // the run ends at the tick
  kResult,     // the states that follow are others
  kPlacement,  // where processes are
  kAccess,     // who may watch and steer
  kQuery,      // nothing changes; the event log has no line of it
  kNote        // something happened that was not asked for
};

// The meaning of a request if the run ended before it was executed.
enum class AtEnd
{
  kRefused,
  kDone,    // the run did what was asked, and more
  kCauses,  // the request itself ends the run, which may be gone before its reply
};

struct ControlVerb
{
  std::string name;
  std::vector<ControlParameter> parameters;
  std::string help;  // one line, without a full stop
  Effect effect = Effect::kQuery;
  Asker who = Asker::kOperator;
  AtEnd at_end = AtEnd::kRefused;
  bool announced = false;  // the run's console tells that it was done
  // Returns the mistake of arguments that are each valid alone, or an empty text.
  std::string (*check)(const ControlOrder& order) = nullptr;

  // Repeated with the states of the run, by --events.
  bool IsRepeated() const { return effect == Effect::kResult || effect == Effect::kEnd; }
};

const std::vector<ControlVerb>& ControlVerbs();
// Returns nullptr if there is no such verb, or `asker` may not use it.
const ControlVerb* FindControlVerb(std::string_view name, Asker asker = Asker::kOwner);
// The verbs that `asker` may use, in the order of the table.
std::vector<std::string> ControlVerbNames(Asker asker);
// "there is no request 'paus'; known are pause, …; did you mean 'pause'?"
std::string NoVerbText(const std::string& verb, Asker asker);

// Returns why the order cannot be executed by any run: the verb, or a missing, unknown or bad argument. Returns an
// empty text if nothing is wrong.
std::string OrderError(const ControlOrder& order, Asker asker = Asker::kOwner);

// "move ENTITY X,Y,Z[,A,B,G]", "reset [--seed N]"
std::string FormOf(const ControlVerb& verb);
// Makes an order of texts: parameters in `named` have theirs there, the others take `words` in the order of the row.
// Throws std::invalid_argument, which says the form.
ControlOrder ParseOrder(const ControlVerb& verb, const std::map<std::string, std::string>& named,
                        const std::vector<std::string>& words);
// Does the reverse: returns a text that ParseOrder reads as the same value.
std::string TextOf(const ControlParameter& parameter, const ControlValue& value);
// "move fb_0 1 2 0", for people.
std::string TextOf(const ControlOrder& order);

// The two columns of an event log: the first argument that names something, and the other arguments as words.
struct OrderColumns
{
  std::string entity;
  std::string numbers;
};
OrderColumns ColumnsOf(const ControlOrder& order);
// Does the reverse. Throws std::invalid_argument.
ControlOrder OrderOf(const ControlVerb& verb, const OrderColumns& columns);

// A line for each verb that `asker` may use: "  FORM    help".
std::string ControlVerbHelp(Asker asker);
// Returns the same as a table in Markdown, for docs/command.md.
std::string ControlVerbTable(Asker asker);

}  // namespace swarmanoid
