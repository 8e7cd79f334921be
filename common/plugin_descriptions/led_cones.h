// The cones within which a robot's LEDs are seen, if its controller has the actuator directional_leds or LEDs that are
// `separate`, which the robot's own body hides. Cameras and
// renderers of all processes use them. They follow from the experiment alone.
#pragma once

#include <optional>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct LedCones
{
  std::vector<Vector3> axes;    // by LED: of length 1, in the frame of its ring
  double observable_angle = 0;  // rad, from the axis to the border
  double cosine = 1;            // cosine of observable_angle
};

// Returns nullopt for a robot whose LEDs are seen from all sides, and for entities that are no robots.
std::optional<LedCones> LedConesOf(const Experiment& experiment, const EntityConfiguration& robot);

// Returns the axes of a layout's LEDs: its directions, or outwards and `elevation` rad above the horizontal.
std::vector<Vector3> AxesOf(const LedLayout& leds, double elevation);

}  // namespace swarmanoid
