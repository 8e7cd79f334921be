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

// Returns the angle from the axis of an LED at which the robot's own body begins to hide it: beside the tangent of its
// round outline.
double AngleBesideBody(const EntityKindDescription& kind)
{
  if (kind.form != BodyForm::kCylinder || kind.leds->places.empty()) return kPi;
  const double led = __builtin_sqrt(kind.leds->places.front().squaredNorm());
  const double part = led > 0 ? std::min(kind.size.x() / led, 1.0) : 1;
  return kPi / 2 + Atan2(__builtin_sqrt(1 - part * part), part);
}

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
  if (device == controller->actuators.end())
  {
    const bool are_separate = std::ranges::any_of(controller->actuators, [](const DeviceConfiguration& actuator)
                                                  { return actuator.tree.GetBoolean("separate", false); });
    if (!are_separate) return std::nullopt;
    const double angle = AngleBesideBody(DescriptionOf(robot.kind));
    return LedCones{.axes = AxesOf(*leds, 0), .observable_angle = angle, .cosine = SinCosOf(angle).cos};
  }
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
