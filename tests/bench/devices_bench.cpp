// Cost of every device that is registered: 1,000 robots, one per square metre, all lit and sending, in one batch.
#include <benchmark/benchmark.h>

#include "bench_world.h"

namespace swarmanoid
{
namespace
{

constexpr int kRobots = 1000;

template <class Interface>
void Step(Interface& batch, const ChannelView& channel, AttributeChanges& changes)
{
  if constexpr (std::is_same_v<Interface, SensorBatch>)
    batch.Update(channel);
  else
    batch.Commit(channel, changes);
}

template <class Interface>
void Run(benchmark::State& state, const PluginDescription& device)
{
  const std::string robot_tag = device.robots.empty() ? "footbot" : device.robots.front();
  const EntityKind kind = robot_tag == "footbot"  ? EntityKind::kFootbot
                          : robot_tag == "eyebot" ? EntityKind::kEyebot
                                                  : EntityKind::kHandbot;
  BenchWorld world(kRobots, 1, kind);
  for (const std::uint32_t robot : world.Robots())
  {
    CSwarmanoidSpaceEntity& entity = world.Space().GetEntity(robot);
    entity.SetAttribute("message", 1);
    for (int led = 0; led < 12; ++led) entity.SetAttribute("led", robot % 2 == 0 ? 0xff0000 : 0x0000ff, led);
    if (kind == EntityKind::kEyebot)
    {
      Pose pose = entity.GetPose();
      pose.position.z() = 1.4;
      world.Space().SetPose(robot, pose);
    }
  }
  const auto* entry = PluginRegistry<Interface>::Instance().Find(device.label, device.implementation);
  const auto batch = entry->create();
  batch->Init({Parameters(TConfigurationTree(std::make_shared<ConfigurationNode>()), device.parameters), world.Space(),
               world.Robots(), StreamName(device.label)});
  const auto width = static_cast<std::size_t>(device.channel_width);
  std::vector<double> values(width * kRobots, 0.1);
  std::vector<std::size_t> offsets;
  for (std::size_t k = 0; k < kRobots; ++k) offsets.push_back(k * width);
  AttributeChanges changes;
  for (auto _ : state)
  {
    world.NextTick();
    changes.Clear();
    Step(*batch, {values, offsets, device.channel_width}, changes);
  }
  state.counters["ns_per_robot"] =
      benchmark::Counter(kRobots * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Interface>
void RegisterAll(const char* what)
{
  for (const auto& [name, entry] : PluginRegistry<Interface>::Instance().Entries())
    benchmark::RegisterBenchmark((std::string(what) + "/" + entry.description.implementation).c_str(), Run<Interface>,
                                 entry.description);
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv)
{
  swarmanoid::RegisterBuiltinDevices();
  swarmanoid::RegisterAll<swarmanoid::SensorBatch>("sensor");
  swarmanoid::RegisterAll<swarmanoid::ActuatorBatch>("actuator");
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
