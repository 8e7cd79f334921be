// Which processes an experiment is run by: their command lines, machines, cores and logs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/bus/security/run_key.h"
#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "common/run/run_settings.h"
#include "launcher/supervision/cluster_member.h"
#include "launcher/supervision/hosts.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{

// The space server's plan is the first. All get the key of the run; none: whoever is in the domain belongs to it.
std::vector<MemberPlan> PlanCluster(const RunSettings& options, const Experiment& experiment,
                                    const Assignment& assignment, const Hosts& hosts, const RunFolder& folder,
                                    int domain, const std::optional<RunKey>& key);

// What to say about --controller-hosts before the start; empty: nothing. `asked`: its value; `robots`: that have
// controllers; `cores`: of this machine, for all of the hosts, or 0 if some are elsewhere.
std::string NoteAboutControllerHosts(unsigned asked, std::size_t robots, std::size_t cores);

// Throws UsageError if `hosts` places what the run does not have.
void RequirePlaces(const RunSettings& options, const Experiment& experiment, const Assignment& assignment,
                   const Hosts& hosts);

}  // namespace swarmanoid
