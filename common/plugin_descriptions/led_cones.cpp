#include "common/plugin_descriptions/led_cones.h"

#include <algorithm>

#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kType = "directional_leds";
constexpr const char* kImplementation = "generic_directional_leds";

}  // namespace

std::vector<Vector3> AxesOf(const LedLayout& leds, double elevation)
{
  std::vector<Vector3> axes;
  for (const Vector3& direction : leds.directions) axes.push_back(direction / __builtin_sqrt(direction.squaredNorm()));
  if (!axes.empty()) return axes;
  const SinCos up = SinCosOf(elevation);
  for (const Vector2& place : leds.places)
  {
    const double radius = __builtin_sqrt(place.squaredNorm());
    // An LED in the middle points to the front.
    const Vector2 out = radius > 0 ? Vector2(place / radius) : Vector2(1, 0);
    axes.emplace_back(up.cos * out.x(), up.cos * out.y(), up.sin);
  }
  return axes;
}

std::optional<LedCones> LedConesOf(const Experiment& experiment, const EntityConfiguration& robot)
{
  const std::optional<LedLayout>& leds = DescriptionOf(robot.kind).leds;
  if (!leds || robot.controller.empty()) return std::nullopt;
  const auto controller = std::ranges::find(experiment.controllers, robot.controller, &ControllerConfiguration::id);
  if (controller == experiment.controllers.end()) return std::nullopt;
  const auto device =
      std::ranges::find_if(controller->actuators, [](const DeviceConfiguration& actuator)
                           { return actuator.type == kType && actuator.implementation == kImplementation; });
  if (device == controller->actuators.end()) return std::nullopt;
  const PluginDescription* description =
      PluginCatalogue::Instance().Find(PluginKind::kActuator, kType, kImplementation);
  const Parameters parameters(device->tree, description->parameters);
  LedCones cones;
  cones.observable_angle = DegreesToRadians(parameters.Number("observable_angle"));
  cones.cosine = SinCosOf(cones.observable_angle).cos;
  cones.axes = AxesOf(*leds, DegreesToRadians(parameters.Number("elevation")));
  return cones;
}

}  // namespace swarmanoid
