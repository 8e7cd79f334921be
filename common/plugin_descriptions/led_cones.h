// The cones within which the LEDs of a robot are seen whose controller has the actuator directional_leds: what cameras
// and renderers of all processes go by. It follows from the experiment alone.
#pragma once

#include <optional>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct LedCones
{
  std::vector<Vector3> axes;    // of each LED: of length 1, in the frame of its ring
  double observable_angle = 0;  // rad, from the axis to the border
  double cosine = 1;            // of it
};

// nullopt for a robot whose LEDs are seen from all sides, and for what is no robot.
std::optional<LedCones> LedConesOf(const Experiment& experiment, const EntityConfiguration& robot);

// The axes of LEDs of a layout: its directions, or outwards and `elevation` rad above the horizontal.
std::vector<Vector3> AxesOf(const LedLayout& leds, double elevation);

}  // namespace swarmanoid
