#include "visualiser/scene/scanner_rays.h"

#include <algorithm>

#include "common/plugins/catalogue.h"
#include "common/space/space.h"

namespace swarmanoid
{

const std::optional<ScannerRays::Drawn>& ScannerRays::Of(std::uint32_t robot)
{
  const std::string& id = space_.GetEntity(robot).GetConfiguration().controller;
  const auto [found, is_new] = scanners_.try_emplace(id);
  std::optional<Drawn>& scanner = found->second;
  const ControllerConfiguration* controller = is_new ? space_.GetExperiment().FindController(id) : nullptr;
  if (controller == nullptr) return scanner;
  const auto device = std::ranges::find_if(
      controller->sensors, [](const DeviceConfiguration& sensor) { return sensor.type == "range_scanner"; });
  if (device == controller->sensors.end()) return scanner;
  const PluginDescription* description =
      PluginCatalogue::Instance().Find(PluginKind::kSensor, device->type, device->implementation);
  // The beams of a user's implementation are drawn if its parameters state them in the same way.
  if (description == nullptr || std::ranges::none_of(description->parameters, [](const ParameterSpec& parameter)
                                                     { return parameter.name == "beams"; }))
    return scanner;
  const RangeScannerBeams beams(Parameters(device->tree, description->parameters));
  scanner = Drawn{beams.position, beams.nearest_m, beams.range_m, {}};
  const std::size_t layers = beams.elevations.size();
  const std::size_t step = (beams.angles.size() * layers + kMostDrawn - 1) / kMostDrawn;
  for (std::size_t i = 0; i < beams.angles.size() * layers; i += step)
    scanner->directions.push_back(beams.DirectionOf(i / layers, i % layers));
  return scanner;
}

void ScannerRays::Find(SpaceQuery& query, std::uint32_t robot, std::vector<ProximityRay>& rays)
{
  const std::optional<Drawn>& scanner = Of(robot);
  if (!scanner) return;
  const Pose pose = space_.GetPose(robot);
  const Vector3 from = pose.Apply(scanner->position);
  for (const Vector3& direction : scanner->directions)
  {
    Vector3 to = from + pose.orientation * (scanner->range * direction);
    const auto first = query.FindFirstHit(from, to, robot, {&robot, 1});
    double hit = first ? first->fraction : 1;
    // Beams end at the floor.
    if (from.z() > 0 && to.z() < 0) hit = std::min(hit, from.z() / (from.z() - to.z()));
    rays.push_back({from, to, hit});
  }
}

}  // namespace swarmanoid
