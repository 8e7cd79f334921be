// A compass: what controllers see of it.
#pragma once

#include "ci_device.h"

class CCI_FootBotCompassSensor : public CCI_Sensor
{
public:
  // Radians, -pi..pi, counter-clockwise from the x axis of the arena.
  virtual double GetHeading() const = 0;

  std::vector<CCI_Column> Columns() const override { return {{"heading", "rad"}}; }
  void ReadColumns(std::vector<double>& values) const override { values.push_back(GetHeading()); }
};
