// The controller's object for a ring of sensors whose readings are computed on demand. Its interface is CCI_RingSensor
// or a class derived from it.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

template <class Interface>
class RingReadings : public Interface
{
public:
  // `angles` are those (rad) of all sensors. There are as many `readings`, which outlive this object.
  RingReadings(const double* readings, const std::vector<double>& angles, OnDemandSensor& batch, std::size_t k)
      : readings_(readings), angles_(angles), batch_(batch), k_(k)
  {
  }
  std::span<const double> GetAllSensorReadings() const override
  {
    batch_.Want(k_);
    return {readings_, angles_.size()};
  }
  double GetAngle(unsigned sensor) const override
  {
    if (sensor >= angles_.size())
      throw std::out_of_range("sensor " + std::to_string(sensor) + " of a ring of " + std::to_string(angles_.size()));
    return angles_[sensor];
  }

private:
  const double* readings_;
  const std::vector<double>& angles_;
  OnDemandSensor& batch_;
  std::size_t k_;
};

}  // namespace swarmanoid
