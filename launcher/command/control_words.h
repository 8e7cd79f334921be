// The words after `swarmanoid control`, and the message if the run does not answer. Used for requests from Python too.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/messages/run_status.h"
#include "idl/control_request_message.h"

namespace swarmanoid
{

struct ControlWords
{
  std::string experiment;  // empty: the one that runs
  ControlOrder order;
};

// `options` has the parameters that are given as --name (ControlParameter::is_option). Throws UsageError with the right
// form.
ControlWords ParseControlWords(std::vector<std::string> words, const std::map<std::string, std::string>& options = {});

// How long a run may stand still without a reply. A process that replaces a worker may have to compute all ticks again.
double PatienceFor(const ControlOrder& order, double otherwise_s);

// Returns the rest of a message after "does not answer": the state of the run. `dropped` is the number of messages that
// were not understood.
std::string WhyNoAnswer(const std::optional<RunStatus>& status, std::uint64_t dropped, bool insecure);

}  // namespace swarmanoid
