// CCI_RangeScannerSensor: a laser scanner for any robot. It measures along many beams in one or several layers. The
// type label is "range_scanner".
#pragma once

#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_RangeScannerSensor : public CCI_SensorOf<CCI_RangeScannerSensor>
{
public:
  // Returns the number of beams of a layer.
  virtual unsigned GetBeams() const = 0;
  // Returns the number of layers.
  virtual unsigned GetLayers() const = 0;
  // Returns the direction (rad) of a beam, counter-clockwise from the front of the robot. Beams run from right to left.
  // The result may exceed pi if the scanner is turned.
  virtual double GetAngle(unsigned beam) const = 0;
  // Returns the angle (rad) of a layer above the plane of the robot's base. Layers run from the lowest up.
  virtual double GetElevation(unsigned layer) const = 0;
  // Returns the shortest and the longest distance (m) that are measured.
  virtual double GetNearest() const = 0;
  virtual double GetRange() const = 0;
  // Returns the position of the scanner (m) in the frame of the robot.
  virtual const Vector3& GetPosition() const = 0;

  // Returns the distances (m) from the scanner along its beams, layer after layer, valid until the next control step.
  // A distance is infinity if nothing is in range, and 0 if something is too near to be measured.
  virtual std::span<const double> GetAllDistances() const = 0;
  // Throws std::out_of_range for a beam that does not exist.
  double GetDistance(unsigned beam, unsigned layer = 0) const
  {
    if (beam >= GetBeams() || layer >= GetLayers())
      throw std::out_of_range("beam " + std::to_string(beam) + " of layer " + std::to_string(layer) +
                              " of a scanner with " + std::to_string(GetBeams()) + " beams in " +
                              std::to_string(GetLayers()) + " layers");
    return GetAllDistances()[static_cast<std::size_t>(layer) * GetBeams() + beam];
  }

  static void Declare(Declaration& columns)
  {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    constexpr auto kPrograms = CCI_Column::For::kPrograms, kPeople = CCI_Column::For::kPeople;
    columns.Add({"distance #", "m", 0, kFar, true, false, kPrograms}, &CCI_RangeScannerSensor::GetAllDistances)
        .Add({"nearest", "m", 0, kFar, true, false, kPeople},
             [](const CCI_RangeScannerSensor& scanner) { return scanner.FindNearest().distance; })
        .Add({"angle of the nearest", "rad", -kFar, kFar, false, false, kPeople},
             [](const CCI_RangeScannerSensor& scanner) { return scanner.GetAngle(scanner.FindNearest().beam); });
  }

private:
  struct Nearest
  {
    double distance = std::numeric_limits<double>::infinity();
    unsigned beam = 0;
  };
  Nearest FindNearest() const
  {
    Nearest nearest;
    const std::span<const double> distances = GetAllDistances();
    for (std::size_t i = 0; i < distances.size(); ++i)
      if (distances[i] < nearest.distance) nearest = {distances[i], static_cast<unsigned>(i % GetBeams())};
    return nearest;
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_RangeScannerSensor;
