#include "common/messages/assignment.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

// The channels of the specific devices of a controller, by name, with their widths.
struct ControllerChannels
{
  std::map<std::string, int> commands;
  std::map<std::string, int> sensors;
  bool has_generic_actuators = false;
  bool may_fail = false;
};

ControllerChannels ChannelsOf(const ControllerConfiguration& controller)
{
  ControllerChannels channels;
  channels.may_fail = controller.MayFail();
  const PluginCatalogue& catalogue = PluginCatalogue::Instance();
  for (const DeviceConfiguration& device : controller.actuators)
  {
    const PluginDescription* description = catalogue.Find(PluginKind::kActuator, device.type, device.implementation);
    if (description == nullptr || description->channel.empty())
      channels.has_generic_actuators = true;
    else
      channels.commands[description->channel] = description->channel_width;
  }
  for (const DeviceConfiguration& device : controller.sensors)
  {
    const PluginDescription* description = catalogue.Find(PluginKind::kSensor, device.type, device.implementation);
    if (description != nullptr && !description->channel.empty())
      channels.sensors[description->channel] = description->channel_width;
  }
  return channels;
}

using ChannelMap = std::map<std::string, int> ControllerChannels::*;

// The blocks of one message: channels in order of their names, robots ascending. `robots` must be ascending.
std::vector<ChannelBlock> MakeBlocks(const std::vector<std::uint32_t>& robots,
                                     const std::vector<const ControllerChannels*>& channels_of, ChannelMap member,
                                     std::size_t& size)
{
  std::map<std::string, ChannelBlock> blocks;
  for (const std::uint32_t robot : robots)
  {
    if (channels_of[robot] == nullptr) continue;
    for (const auto& [name, width] : channels_of[robot]->*member)
    {
      ChannelBlock& block = blocks[name];
      block.name = name;
      block.width = width;
      block.entities.push_back(robot);
    }
  }
  std::vector<ChannelBlock> ordered;
  size = 0;
  for (auto& [name, block] : blocks)
  {
    block.offset = size;
    size += block.entities.size() * static_cast<std::size_t>(block.width);
    ordered.push_back(std::move(block));
  }
  return ordered;
}

// Copies that bring the values of `source` blocks to their places in `target` blocks; neighbouring ones are merged.
void AppendCopies(std::uint32_t source_index, const std::vector<ChannelBlock>& source,
                  const std::vector<ChannelBlock>& target, std::vector<ValueCopy>& copies)
{
  for (const ChannelBlock& to : target)
  {
    const auto from =
        std::find_if(source.begin(), source.end(), [&](const ChannelBlock& b) { return b.name == to.name; });
    if (from == source.end()) continue;
    const auto width = static_cast<std::size_t>(to.width);
    std::size_t k = 0;
    for (std::size_t n = 0; n < to.entities.size(); ++n)
    {
      while (k < from->entities.size() && from->entities[k] < to.entities[n]) ++k;
      if (k == from->entities.size()) break;
      if (from->entities[k] != to.entities[n]) continue;
      const ValueCopy copy{source_index, from->offset + k * width, to.offset + n * width, width};
      ValueCopy* last = copies.empty() ? nullptr : &copies.back();
      if (last != nullptr && last->source == copy.source && last->from + last->count == copy.from &&
          last->to + last->count == copy.to)
        last->count += width;
      else
        copies.push_back(copy);
    }
  }
}

std::vector<std::uint32_t> SourcesOf(const std::vector<ValueCopy>& copies)
{
  std::vector<std::uint32_t> sources;
  for (const ValueCopy& copy : copies) sources.push_back(copy.source);
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

// Orders robots so that those of the hosts from `first` to before `last` stand one behind the other, near ones
// together: halved across the longer side of where they start, again and again. `begin`: of the robots of each host,
// and the end. They come ordered by engine; where they are of several, these are kept apart.
void OrderByPlace(const Experiment& experiment, const std::vector<int>& owner, std::span<const std::size_t> begin,
                  std::size_t first, std::size_t last, std::vector<std::uint32_t>& robots)
{
  if (last - first < 2) return;
  const std::size_t middle = (first + last) / 2;
  const auto at = [&](std::size_t host) { return robots.begin() + static_cast<std::ptrdiff_t>(begin[host]); };
  const std::span<const std::uint32_t> these(at(first), at(last));
  if (!these.empty() && owner[these.front()] == owner[these.back()])
  {
    const auto place_of = [&](std::uint32_t robot) { return experiment.entities[robot].pose.position; };
    Vector3 low = place_of(these.front()), high = low;
    for (const std::uint32_t robot : these)
    {
      low = low.cwiseMin(place_of(robot));
      high = high.cwiseMax(place_of(robot));
    }
    const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    std::nth_element(at(first), at(middle), at(last),
                     [&](std::uint32_t a, std::uint32_t b)
                     { return std::pair(place_of(a)[axis], a) < std::pair(place_of(b)[axis], b); });
  }
  OrderByPlace(experiment, owner, begin, first, middle, robots);
  OrderByPlace(experiment, owner, begin, middle, last, robots);
}

}  // namespace

Assignment MakeAssignment(const Experiment& experiment, unsigned hosts)
{
  Assignment assignment;
  const std::size_t count = experiment.entities.size();

  // Engines: a movable entity is owned by the first engine that lists it.
  assignment.owner.assign(count, -1);
  assignment.engines.resize(experiment.engines.size());
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
  {
    EngineLayout& layout = assignment.engines[e];
    for (const std::uint32_t entity : experiment.engines[e].entities)
    {
      if (!experiment.entities[entity].movable || IsBodiless(experiment.entities[entity].kind))
        layout.fixed.push_back(entity);
      else if (assignment.owner[entity] < 0)
      {
        assignment.owner[entity] = static_cast<int>(e);
        layout.owned.push_back(entity);
      }
      else
        layout.mirrored.push_back(entity);
    }
  }

  // Controllers: what each robot's devices exchange.
  std::map<std::string, ControllerChannels> channels_by_id;
  for (const ControllerConfiguration& controller : experiment.controllers)
    channels_by_id.emplace(controller.id, ChannelsOf(controller));
  std::vector<const ControllerChannels*> channels_of(count, nullptr);
  std::vector<std::uint32_t> robots;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const EntityConfiguration& entity = experiment.entities[i];
    if (!IsRobot(entity.kind) || entity.controller.empty()) continue;
    channels_of[i] = &channels_by_id.at(entity.controller);
    robots.push_back(i);
  }

  // Hosts: as many robots each, ordered by engine, then place.
  std::stable_sort(robots.begin(), robots.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return assignment.owner[a] < assignment.owner[b]; });
  const std::size_t host_count = std::clamp<std::size_t>(hosts, 1, std::max<std::size_t>(robots.size(), 1));
  assignment.host.assign(count, -1);
  assignment.hosts.resize(host_count);
  std::vector<std::size_t> begins;
  for (std::size_t h = 0; h <= host_count; ++h) begins.push_back(h * robots.size() / host_count);
  OrderByPlace(experiment, assignment.owner, begins, 0, host_count, robots);
  for (std::size_t h = 0; h < host_count; ++h)
  {
    HostLayout& layout = assignment.hosts[h];
    layout.robots.assign(robots.begin() + static_cast<std::ptrdiff_t>(begins[h]),
                         robots.begin() + static_cast<std::ptrdiff_t>(begins[h + 1]));
    std::sort(layout.robots.begin(), layout.robots.end());
    for (const std::uint32_t robot : layout.robots)
    {
      assignment.host[robot] = static_cast<int>(h);
      layout.reports_to_server |= channels_of[robot]->has_generic_actuators || channels_of[robot]->commands.empty() ||
                                  assignment.owner[robot] < 0;
      layout.reports_to_server |= channels_of[robot]->may_fail;
    }
    layout.commands = MakeBlocks(layout.robots, channels_of, &ControllerChannels::commands, layout.command_size);
    layout.sensors = MakeBlocks(layout.robots, channels_of, &ControllerChannels::sensors, layout.sensor_size);
  }

  for (std::size_t e = 0; e < assignment.engines.size(); ++e)
  {
    EngineLayout& layout = assignment.engines[e];
    layout.commands = MakeBlocks(layout.owned, channels_of, &ControllerChannels::commands, layout.command_size);
    layout.sensors = MakeBlocks(layout.owned, channels_of, &ControllerChannels::sensors, layout.sensor_size);
    for (std::uint32_t h = 0; h < host_count; ++h)
    {
      AppendCopies(h, assignment.hosts[h].commands, layout.commands, layout.command_copies);
      AppendCopies(static_cast<std::uint32_t>(e), layout.sensors, assignment.hosts[h].sensors,
                   assignment.hosts[h].sensor_copies);
    }
    layout.commands_from = SourcesOf(layout.command_copies);
  }
  for (HostLayout& layout : assignment.hosts) layout.frames_from = SourcesOf(layout.sensor_copies);
  return assignment;
}

std::string EngineName(const Experiment& experiment, std::size_t engine)
{
  return "engine '" + experiment.engines[engine].id + "'";
}

std::string RegionName(const Experiment& experiment, std::size_t engine, unsigned region)
{
  return "region " + std::to_string(region) + " of " + EngineName(experiment, engine);
}

unsigned RegionsOf(const EngineConfiguration& engine) { return engine.split.regions > 1 ? engine.split.regions : 0; }

unsigned RegionNumber(const Experiment& experiment, std::size_t engine, unsigned region)
{
  for (std::size_t e = 0; e < engine; ++e) region += RegionsOf(experiment.engines[e]);
  return region;
}

std::string HostName(std::size_t host) { return "controller host " + std::to_string(host); }

std::string OwnerName(const Experiment& experiment, const Assignment& assignment, std::size_t entity)
{
  const int engine = assignment.owner[entity];
  return engine < 0 ? std::string() : EngineName(experiment, static_cast<std::size_t>(engine));
}

std::string HostNameOf(const Assignment& assignment, std::size_t entity)
{
  const int host = assignment.host[entity];
  return host < 0 ? std::string() : HostName(static_cast<std::size_t>(host));
}

}  // namespace swarmanoid
