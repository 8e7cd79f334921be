#include "common/messages/assignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ranges>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/experiment/battery_model.h"
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
  bool has_battery = false;  // the server computes its charge from what the host reports
};

// Returns the most joints of a robot in the experiment.
int MostJoints(const Experiment& experiment)
{
  std::size_t most = 0;
  for (const EntityConfiguration& entity : experiment.entities)
    most = std::max(most, DescriptionOf(entity.kind).links.size());
  return static_cast<int>(most);
}

ControllerChannels ChannelsOf(const ControllerConfiguration& controller, int most_joints)
{
  const auto width = [most_joints](const PluginDescription& description)
  { return description.channel_width * (description.channel_is_per_joint ? most_joints : 1); };
  ControllerChannels channels;
  channels.may_fail = controller.MayFail();
  const PluginCatalogue& catalogue = PluginCatalogue::Instance();
  for (const DeviceConfiguration& device : controller.actuators)
  {
    const PluginDescription* description = catalogue.Find(PluginKind::kActuator, device.type, device.implementation);
    if (description == nullptr || description->channel.empty())
      channels.has_generic_actuators = true;
    else
      channels.commands[description->channel] = width(*description);
  }
  for (const DeviceConfiguration& device : controller.sensors)
  {
    const PluginDescription* description = catalogue.Find(PluginKind::kSensor, device.type, device.implementation);
    if (description != nullptr && !description->channel.empty())
      channels.sensors[description->channel] = width(*description);
    channels.has_battery |= device.type == "battery" && device.implementation == kEnergyBattery;
  }
  return channels;
}

using ChannelMap = std::map<std::string, int> ControllerChannels::*;

// Returns the blocks of one message: channels in order of their names, robots ascending. `robots` must be ascending.
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
// The copies for robots in `changing` (ascending) go to `of_changing`, one for each robot.
void AppendCopies(std::uint32_t source_index, const std::vector<ChannelBlock>& source,
                  const std::vector<ChannelBlock>& target, std::vector<ValueCopy>& copies,
                  std::span<const std::uint32_t> changing = {}, std::vector<RobotCopy>* of_changing = nullptr)
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
      if (std::ranges::binary_search(changing, to.entities[n]))
      {
        of_changing->push_back({to.entities[n], copy});
        continue;
      }
      ValueCopy* last = copies.empty() ? nullptr : &copies.back();
      if (last != nullptr && last->source == copy.source && last->from + last->count == copy.from &&
          last->to + last->count == copy.to)
        last->count += width;
      else
        copies.push_back(copy);
    }
  }
}

std::vector<std::uint32_t> SourcesOf(const std::vector<ValueCopy>& copies, const std::vector<RobotCopy>& others = {})
{
  std::vector<std::uint32_t> sources;
  for (const ValueCopy& copy : copies) sources.push_back(copy.source);
  for (const RobotCopy& other : others) sources.push_back(other.copy.source);
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  return sources;
}

// Returns the robots with a controller, ascending.
std::vector<std::uint32_t> RobotsOf(const Experiment& experiment)
{
  std::vector<std::uint32_t> robots;
  for (std::uint32_t i = 0; i < experiment.entities.size(); ++i)
    if (IsRobot(experiment.entities[i].kind) && !experiment.entities[i].controller.empty()) robots.push_back(i);
  return robots;
}

// Returns the position of each entity in the plane.
std::vector<Vector2> PlacesOf(const Experiment& experiment, std::span<const double> poses)
{
  std::vector<Vector2> places;
  places.reserve(experiment.entities.size());
  const auto movable =
      static_cast<std::size_t>(std::ranges::count_if(experiment.entities, &EntityConfiguration::movable));
  if (!poses.empty() && poses.size() != 7 * movable)
    throw std::runtime_error("the places of the robots are those of other entities than the experiment has");
  std::size_t k = 0;
  for (const EntityConfiguration& entity : experiment.entities)
  {
    places.push_back(entity.pose.position.head<2>());
    if (!entity.movable) continue;
    if (!poses.empty()) places.back() = {poses[k], poses[movable + k]};
    ++k;
  }
  return places;
}

// Orders the robots of the hosts from `first` to before `last` so that near ones are together. The set is halved across
// the longer side of its area, again and again. `begin` has the start of each host's robots, and the end. The robots
// come ordered by engine; robots of different engines are kept apart.
void OrderByPlace(const std::vector<Vector2>& places, const std::vector<int>& owner, std::span<const std::size_t> begin,
                  std::size_t first, std::size_t last, std::vector<std::uint32_t>& robots)
{
  if (last - first < 2) return;
  const std::size_t middle = (first + last) / 2;
  const auto at = [&](std::size_t host) { return robots.begin() + static_cast<std::ptrdiff_t>(begin[host]); };
  const std::span<const std::uint32_t> these(at(first), at(last));
  if (!these.empty() && owner[these.front()] == owner[these.back()])
  {
    Vector2 low = places[these.front()], high = low;
    for (const std::uint32_t robot : these)
    {
      low = low.cwiseMin(places[robot]);
      high = high.cwiseMax(places[robot]);
    }
    const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    std::nth_element(at(first), at(middle), at(last),
                     [&](std::uint32_t a, std::uint32_t b)
                     { return std::pair(places[a][axis], a) < std::pair(places[b][axis], b); });
  }
  OrderByPlace(places, owner, begin, first, middle, robots);
  OrderByPlace(places, owner, begin, middle, last, robots);
}

}  // namespace

bool IsSound(const HostTable& table)
{
  return table.hosts >= 1 && table.hosts <= std::max<std::size_t>(table.of_robots.size(), 1) &&
         std::ranges::all_of(table.of_robots, [&](std::uint32_t host) { return host < table.hosts; });
}

HostTable DealRobots(const Experiment& experiment, unsigned hosts, std::span<const double> poses)
{
  const std::vector<std::uint32_t> robots = RobotsOf(experiment);
  HostTable table;
  table.hosts = static_cast<std::uint32_t>(std::clamp<std::size_t>(hosts, 1, std::max<std::size_t>(robots.size(), 1)));
  table.of_robots.resize(robots.size());
  if (table.hosts == 1) return table;

  // Each host gets about as many robots, ordered by engine, then position.
  const std::vector<int> owner = StartEngines(experiment);
  std::vector<std::uint32_t> ordered = robots;
  std::ranges::stable_sort(ordered, {}, [&](std::uint32_t robot) { return owner[robot]; });
  std::vector<std::size_t> begins;
  for (std::size_t h = 0; h <= table.hosts; ++h) begins.push_back(h * robots.size() / table.hosts);
  OrderByPlace(PlacesOf(experiment, poses), owner, begins, 0, table.hosts, ordered);
  std::vector<std::uint32_t> host(experiment.entities.size());
  for (std::uint32_t h = 0; h < table.hosts; ++h)
    for (std::size_t k = begins[h]; k < begins[h + 1]; ++k) host[ordered[k]] = h;
  std::ranges::transform(robots, table.of_robots.begin(), [&](std::uint32_t robot) { return host[robot]; });
  return table;
}

Assignment MakeAssignment(const Experiment& experiment, unsigned hosts)
{
  return MakeAssignment(experiment, DealRobots(experiment, hosts));
}

Assignment MakeAssignment(const Experiment& experiment, const HostTable& table)
{
  Assignment assignment;
  assignment.table = table;
  const std::size_t count = experiment.entities.size();

  // Engines.
  assignment.owner = StartEngines(experiment);
  assignment.engines.resize(experiment.engines.size());
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
  {
    EngineLayout& layout = assignment.engines[e];
    for (const std::uint32_t entity : experiment.engines[e].entities)
    {
      const std::span<const std::uint32_t> choices = experiment.engine_choices.Of(entity);
      if (!experiment.entities[entity].movable || IsBodiless(experiment.entities[entity].kind))
        layout.fixed.push_back(entity);
      else if (std::ranges::find(choices, static_cast<std::uint32_t>(e)) != choices.end())
      {
        layout.members.push_back({static_cast<std::uint32_t>(layout.owned.size()),
                                  static_cast<std::uint32_t>(experiment.engine_choices.PlaceOf(entity))});
        layout.owned.push_back(entity);
        if (choices.size() == 1) continue;
        layout.mirrored.push_back(entity);
        layout.changing.push_back(entity);
      }
      else if (assignment.owner[entity] == static_cast<int>(e))
        layout.owned.push_back(entity);
      else
        layout.mirrored.push_back(entity);
    }
  }

  // Controllers: what each robot's devices exchange.
  std::map<std::string, ControllerChannels> channels_by_id;
  const int most_joints = MostJoints(experiment);
  for (const ControllerConfiguration& controller : experiment.controllers)
    channels_by_id.emplace(controller.id, ChannelsOf(controller, most_joints));
  std::vector<const ControllerChannels*> channels_of(count, nullptr);
  const std::vector<std::uint32_t> robots = RobotsOf(experiment);
  for (const std::uint32_t robot : robots)
    channels_of[robot] = &channels_by_id.at(experiment.entities[robot].controller);

  // Hosts.
  if (table.of_robots.size() != robots.size() || !IsSound(table))
    throw std::runtime_error(
        fmt::format("a table of controller hosts is of {} robots and {} hosts, not of the {} robots "
                    "of the experiment",
                    table.of_robots.size(), table.hosts, robots.size()));
  assignment.host.assign(count, -1);
  assignment.hosts.resize(table.hosts);
  for (std::size_t k = 0; k < robots.size(); ++k) assignment.hosts[table.of_robots[k]].robots.push_back(robots[k]);
  for (std::size_t h = 0; h < table.hosts; ++h)
  {
    HostLayout& layout = assignment.hosts[h];
    for (const std::uint32_t robot : layout.robots)
    {
      assignment.host[robot] = static_cast<int>(h);
      layout.reports_to_server |= channels_of[robot]->has_generic_actuators || channels_of[robot]->commands.empty() ||
                                  assignment.owner[robot] < 0;
      layout.reports_to_server |= channels_of[robot]->may_fail || channels_of[robot]->has_battery;
    }
    layout.commands = MakeBlocks(layout.robots, channels_of, &ControllerChannels::commands, layout.command_size);
    layout.sensors = MakeBlocks(layout.robots, channels_of, &ControllerChannels::sensors, layout.sensor_size);
  }

  for (std::size_t e = 0; e < assignment.engines.size(); ++e)
  {
    EngineLayout& layout = assignment.engines[e];
    layout.commands = MakeBlocks(layout.owned, channels_of, &ControllerChannels::commands, layout.command_size);
    layout.sensors = MakeBlocks(layout.owned, channels_of, &ControllerChannels::sensors, layout.sensor_size);
    for (std::uint32_t h = 0; h < table.hosts; ++h)
    {
      AppendCopies(h, assignment.hosts[h].commands, layout.commands, layout.command_copies);
      AppendCopies(static_cast<std::uint32_t>(e), layout.sensors, assignment.hosts[h].sensors,
                   assignment.hosts[h].sensor_copies, layout.changing, &assignment.hosts[h].sensor_choices);
    }
    layout.commands_from = SourcesOf(layout.command_copies);
  }
  for (HostLayout& layout : assignment.hosts)
    layout.frames_from = SourcesOf(layout.sensor_copies, layout.sensor_choices);
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
