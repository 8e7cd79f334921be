// What a controller host remembers, robot by robot: so other hosts, of whatever number, can go on with its robots.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/checkpoint/checkpoint.h"
#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "common/serialisation/bytes.h"

namespace swarmanoid
{

struct HostState
{
  // What robots of a sensor have in common, by the numbers of their controller and of its sensor: the same at all
  // hosts.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> sensors;
  std::map<std::uint32_t, std::string> robots;  // by entity: its controller, and its devices
};

void Write(const HostState& state, ByteWriter& bytes);
// Throws std::runtime_error if the image ends too early.
HostState ReadHostState(ByteReader& bytes);

// The names of what the processes of a run with so many controller hosts save.
std::vector<std::string> PartsOf(const Experiment& experiment, std::size_t hosts);

// The parts with those of these controller hosts in the place of those that are there. Throws std::runtime_error if the
// state of a robot is missing.
std::vector<SavedPart> SharedOut(std::vector<SavedPart> parts, const Experiment& experiment, const HostTable& hosts);

}  // namespace swarmanoid
