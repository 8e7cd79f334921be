#include "common/bus/membership/worker_world.h"

#include <fmt/format.h>

#include "common/bus/bus.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

bool IsSame(const CSwarmanoidSpaceEntity& entity, const WorldEntity& told)
{
  return entity.GetId() == told.id && TagName(entity.GetKind()) == told.kind && entity.IsMovable() == told.movable &&
         entity.FirstSlot() == told.first_slot;
}

}  // namespace

std::unique_ptr<Experiment> LoadWorld(const WorldMessage& world, const LoadOptions& options)
{
  LoadedExperiment loaded = LoadExperimentText(world.xml, world.file, world.folder, options);
  if (!loaded.experiment)
  {
    std::string text;
    for (const Diagnostic& error : loaded.errors) text += fmt::format("{}{}", text.empty() ? "" : "\n", error.Text());
    throw ConfigurationError(text);
  }
  return std::move(loaded.experiment);
}

WorkerWorld::WorkerWorld(const WorldMessage& world, bool load_controllers)
{
  LoadOptions options;
  options.check_files = load_controllers;
  experiment = LoadWorld(world, options);
  space = std::make_unique<CSwarmanoidSpace>(*experiment);

  // A worker on another machine may have other plug-ins under the same names, and so another world.
  bool is_same = space->Size() == world.entities.size();
  for (std::size_t i = 0; is_same && i < space->Size(); ++i) is_same = IsSame(space->GetEntity(i), world.entities[i]);
  if (!is_same)
    throw BusError(
        "the entities made from the experiment differ from those of the space server; use programs of one build");
  try
  {
    assignment = MakeAssignment(*experiment, world.hosts);
  }
  catch (const std::runtime_error& error)
  {
    throw BusError(error.what());
  }
  limits = std::make_unique<const TickLimits>(*space, assignment, world.recorded);
  if (!world.checkpoint.empty()) checkpoint = DecodeCheckpoint(world.checkpoint);
}

void WorkerWorld::RestoreSpace()
{
  if (checkpoint) space->Apply(checkpoint->snapshot);
}

WorldMessage DescribeWorld(const CSwarmanoidSpace& space, std::uint64_t run, const std::string& file,
                           const HostTable& hosts)
{
  const Experiment& experiment = space.GetExperiment();
  WorldMessage world;
  world.run = run;
  world.experiment = experiment.name;
  world.file = file;
  world.folder = experiment.folder;
  world.xml = experiment.effective_xml;
  world.seed = experiment.seed;
  world.hosts = hosts;
  world.tick_seconds = experiment.TickSeconds();
  world.entities.reserve(space.Size());
  for (std::size_t i = 0; i < space.Size(); ++i)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(i);
    world.entities.push_back(
        {entity.GetId(), std::string(TagName(entity.GetKind())), entity.IsMovable(), entity.FirstSlot()});
  }
  return world;
}

bool HostsAskForParts(const WorldMessage& world) { return world.spread && world.hosts.hosts > 1; }

bool EnginesHearParts(const WorldMessage& world) { return world.spread; }

std::string PartNameOfEngine(std::size_t engine) { return "engine " + std::to_string(engine); }

// No engine waits for a host without robots, so the server does.
bool ServerHears(const HostLayout& host) { return host.reports_to_server || host.robots.empty(); }

}  // namespace swarmanoid
