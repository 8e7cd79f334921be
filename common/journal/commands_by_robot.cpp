// The values of commands lie in one block for each channel and host, robot by robot. For a pair of host tables the
// class computes once which ranges go where, and then copies ranges at each tick. Attributes and faults name their
// robots, so they are dealt out one by one.
//
// Invariant: with equal tables the result is the input, bit for bit; otherwise it is what the other hosts would have
// sent.
#include "common/journal/commands_by_robot.h"

#include <algorithm>
#include <stdexcept>

#include "common/journal/tick_records.h"
#include "common/messages/attribute_changes.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"

namespace swarmanoid
{

void CommandsByRobot::MakeCopies(const HostTable& hosts)
{
  if (from_ == hosts) return;
  const Assignment from = MakeAssignment(space_.GetExperiment(), hosts);
  from_ = hosts;
  copies_.clear();
  for (std::size_t h = 0; h < to_.hosts.size(); ++h)
    for (const ChannelBlock& block : to_.hosts[h].commands)
      for (std::size_t k = 0; k < block.entities.size(); ++k)
      {
        const auto source = static_cast<std::size_t>(from.host[block.entities[k]]);
        const std::vector<ChannelBlock>& blocks = from.hosts[source].commands;
        const auto other = std::find_if(blocks.begin(), blocks.end(),
                                        [&](const ChannelBlock& candidate) { return candidate.name == block.name; });
        const auto place = std::lower_bound(other->entities.begin(), other->entities.end(), block.entities[k]);
        const auto width = static_cast<std::size_t>(block.width);
        copies_.push_back({source, other->offset + static_cast<std::size_t>(place - other->entities.begin()) * width, h,
                           block.offset + k * width, width});
      }
}

std::vector<ControlCommands> CommandsByRobot::Of(const HostTable& hosts, const std::vector<ControlCommands>& commands)
{
  // The last tick has no commands.
  if (commands.empty() || hosts == to_.table) return commands;
  MakeCopies(hosts);
  std::vector<ControlCommands> shared(to_.hosts.size());
  for (std::size_t h = 0; h < shared.size(); ++h)
  {
    shared[h].tick = commands.front().tick;
    shared[h].host = static_cast<std::uint32_t>(h);
    shared[h].values.resize(to_.hosts[h].command_size);
  }
  for (const Copy& copy : copies_)
    std::copy_n(commands.at(copy.source).values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                shared[copy.host].values.begin() + static_cast<std::ptrdiff_t>(copy.to));
  const auto of_robot = [&](std::uint32_t robot) -> ControlCommands&
  { return shared.at(static_cast<std::size_t>(to_.host.at(robot))); };
  std::vector<RecordedFault> faults;
  for (const ControlCommands& of_host : commands)
  {
    for (std::size_t i = 0; i < of_host.attributes.slots.size(); ++i)
    {
      const std::uint32_t slot = of_host.attributes.slots[i];
      of_robot(EntityOfSlot(space_, slot)).attributes.Add(slot, of_host.attributes.values[i]);
    }
    for (std::size_t i = 0; i < of_host.faults.robots.size(); ++i)
      faults.push_back({of_host.tick, of_host.faults.robots[i], of_host.faults.kinds[i]});
  }
  std::sort(faults.begin(), faults.end());
  for (const RecordedFault& fault : faults)
  {
    of_robot(fault.robot).faults.robots.push_back(fault.robot);
    of_robot(fault.robot).faults.kinds.push_back(fault.kind);
  }
  AttributeOrder order;
  for (ControlCommands& of_host : shared) order.Apply(of_host.attributes);
  return shared;
}

std::vector<char> CommandsByRobot::Of(const HostTable& hosts, std::vector<char> block, std::uint32_t ticks)
{
  const auto header = JournalBlockAt(block, block.size());
  if (hosts == to_.table && header && header->ticks == ticks) return block;
  TickRows rows;
  TickRecord record;
  for (TickRecordReader records(JournalContent(block), ticks); records.Next(record);)
    if (!rows.Add(record.state, record.save, record.frames, Of(hosts, record.commands)))
      throw std::runtime_error("the journal has ticks of different lengths in one block");
  ReusedMemory room;
  const std::span<const char> encoded =
      EncodeJournalBlock(JournalBlockKind::kTicks, rows.FirstTick(), rows.Ticks(), rows.Content(room));
  return {encoded.begin(), encoded.end()};
}

}  // namespace swarmanoid
