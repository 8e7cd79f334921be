// The directions of the beams of a range scanner, from its parameters. The sensor measures along them, and visualisers
// draw them.
#pragma once

#include <vector>

#include "common/configuration/parameter.h"
#include "common/math/elementary.h"
#include "common/math/pose.h"

namespace swarmanoid
{

struct RangeScannerBeams
{
  std::vector<double> angles;      // rad, of the beams of a layer: ascending, evenly spaced, 0 ahead
  std::vector<double> elevations;  // rad, of the layers: ascending
  double pan = 0;                  // rad: the direction of angle 0, to the left of the robot's front
  double spacing = 0;              // rad, of neighbouring beams
  double nearest_m = 0, range_m = 0;
  Vector3 position = Vector3::Zero();  // m, of the scanner in the frame of the robot

  explicit RangeScannerBeams(const Parameters& parameters)
      : pan(DegreesToRadians(parameters.Number("pan"))),
        nearest_m(parameters.Number("nearest")),
        range_m(parameters.Number("range")),
        position(parameters.Vector3Of("position"))
  {
    const auto beams = static_cast<unsigned>(parameters.Integer("beams"));
    const double width = DegreesToRadians(parameters.Number("field_of_view"));
    const bool is_full_turn = parameters.Number("field_of_view") == 360;
    spacing = beams == 1 ? 0 : is_full_turn ? width / beams : width / (beams - 1);
    for (unsigned i = 0; i < beams; ++i) angles.push_back(beams == 1 ? 0 : i * spacing - width / 2);
    const auto layers = static_cast<unsigned>(parameters.Integer("layers"));
    const double height = DegreesToRadians(parameters.Number("vertical_field_of_view"));
    for (unsigned i = 0; i < layers; ++i)
      elevations.push_back(layers == 1 ? 0 : i * height / (layers - 1) - height / 2);
  }

  // Returns the unit vector of a beam in the frame of the robot.
  Vector3 DirectionOf(std::size_t beam, std::size_t layer) const
  {
    const SinCos around = SinCosOf(angles[beam] + pan);
    const SinCos up = SinCosOf(elevations[layer]);
    return {up.cos * around.cos, up.cos * around.sin, up.sin};
  }
};

}  // namespace swarmanoid
