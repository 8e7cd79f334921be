// A run may continue with another number of controller hosts than saved it. The states of all old hosts are joined in
// one map by robot and dealt out by the new table. The states that sensors share between robots go to each new host.
//
// Invariant: the state of each robot goes to exactly one host; a robot without a state is an error.
#include "common/checkpoint/host_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace swarmanoid
{

std::vector<std::string> PartsOf(const Experiment& experiment, std::size_t hosts)
{
  std::vector<std::string> parts{kServerPart};
  for (std::size_t e = 0; e < experiment.engines.size(); ++e) parts.push_back(EngineName(experiment, e));
  for (std::size_t h = 0; h < hosts; ++h) parts.push_back(HostName(h));
  return parts;
}

std::vector<SavedPart> SharedOut(std::vector<SavedPart> parts, const Experiment& experiment, const HostTable& hosts)
{
  // A single host that had all robots still has them.
  if (hosts.hosts == 1 && std::ranges::find(parts, HostName(1), &SavedPart::name) == parts.end()) return parts;
  HostState all;
  for (std::size_t h = 0;; ++h)
  {
    const auto part =
        std::find_if(parts.begin(), parts.end(), [&](const SavedPart& other) { return other.name == HostName(h); });
    if (part == parts.end()) break;
    ByteReader bytes(part->state);
    auto state = ReadFields<HostState>(bytes);
    all.sensors.merge(state.sensors);
    all.robots.merge(state.robots);
    parts.erase(part);
  }
  const Assignment assignment = MakeAssignment(experiment, hosts);
  for (std::size_t h = 0; h < assignment.hosts.size(); ++h)
  {
    HostState state;
    state.sensors = all.sensors;
    for (const std::uint32_t robot : assignment.hosts[h].robots)
    {
      const auto found = all.robots.find(robot);
      if (found == all.robots.end())
        throw std::runtime_error(
            fmt::format("the state of robot '{}' is missing, so it cannot be given to {}; restore it with as many "
                        "--controller-hosts as the run had",
                        experiment.entities[robot].id, HostName(h)));
      state.robots.insert(all.robots.extract(found));
    }
    ByteWriter bytes;
    WriteFields(bytes, state);
    parts.push_back({HostName(h), bytes.Bytes()});
  }
  return parts;
}

}  // namespace swarmanoid
