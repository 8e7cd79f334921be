// The devices for the fields on the floor, which any robot can carry.
#include <algorithm>
#include <cmath>

#include "common/configuration/configuration_tree.h"
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugin_descriptions/field_points.h"
#include "common/plugins/noise_parameters.h"
#include "common/plugins/parameter_checks.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

constexpr double kFarthest_m = 1e3;  // from the middle of the robot

std::vector<ConfigurationError> MistakesInPoints(const Parameters& parameters)
{
  if (FieldPoints(parameters.Text("points"))) return {};
  return {ConfigurationError(parameters.Tree().ValueLocation("points"),
                             "'points' of <" + parameters.Tree().Name() + "> is '" + parameters.Text("points") +
                                 "'; it must be 1 to " + std::to_string(kMostFieldPoints) +
                                 " points in m with semicolons between, such as 0.08, 0.04; 0.08, -0.04")};
}

}  // namespace

std::optional<std::vector<Vector2>> FieldPoints(std::string_view text)
{
  std::vector<Vector2> points;
  while (true)
  {
    const std::size_t end = std::min(text.find(';'), text.size());
    const auto numbers = ParseNumbers(text.substr(0, end));
    if (!numbers || numbers->size() != 2 || points.size() == kMostFieldPoints) return std::nullopt;
    for (const double number : *numbers)
      if (!(std::abs(number) <= kFarthest_m)) return std::nullopt;
    points.emplace_back((*numbers)[0], (*numbers)[1]);
    if (end == text.size()) return points;
    text.remove_prefix(end + 1);
  }
}

void DescribeFloorFieldDevices()
{
  DescribeActuator({.label = "floor_field",
                    .implementation = "generic_floor_field",
                    .brief = "deposits on the fields of the floor, under a point of the robot",
                    .parameters = Joined({{"point", kVector2, "m", "0, 0", "Where, in the frame of the robot.",
                                           -kFarthest_m, kFarthest_m}},
                                         NoiseParameters("each rate that is not 0", "1/s"))});
  const PluginDescription sensor{
      .label = "floor_field",
      .implementation = "generic_floor_field",
      .brief = "value and gradient of the fields of the floor at points of the robot",
      .parameters = Joined(Joined({{"points", kText, "m", "0, 0",
                                    "The points in the frame of the robot, as x, y; x, y with semicolons between."}},
                                  NoiseParameters("each value", "1/m²", "value_")),
                           NoiseParameters("each component of a gradient", "1/m³", "gradient_"))};
  ParameterChecks::Instance().Add(PluginKind::kSensor, sensor, MistakesInPoints);
  DescribeSensor(sensor);
}

}  // namespace swarmanoid
