// Which processes an experiment is run by: their command lines, machines, cores and logs.
#pragma once

#include <vector>

#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "common/run/run_settings.h"
#include "launcher/hosts.h"
#include "launcher/processes/cluster_member.h"
#include "launcher/run_folder.h"

namespace swarmanoid
{

// The space server's plan is the first. Throws UsageError if `hosts` places what the experiment does not have.
std::vector<MemberPlan> PlanCluster(const RunSettings& options, const Experiment& experiment,
                                    const Assignment& assignment, const Hosts& hosts, const RunFolder& folder,
                                    int domain);

}  // namespace swarmanoid
