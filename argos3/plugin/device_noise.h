// Noise of ARGoS3's sensors that our parameters do not provide. The robot draws it. Options of the controller
// (argos3/converter/convert_code.cpp) set the amount; without them there is none.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>

#include "argos3/plugin/device_adapters.h"

namespace swarmanoid::argos3
{

// Adds the noise noise_std_dev of range_and_bearing: a vector in any direction with a Gaussian length (m).
void DisturbDirection(RandomStream& random, double deviation_m, Vector3& to_sender);

// Adds the noise noise_std_dev of cameras: a vector in the plane, in proportion to the distance.
void DisturbBlob(RandomStream& random, double deviation, double& distance, double& angle_rad);

// The noise vel_noise_range and dist_noise_range of differential_steering, uniform in cm/s and cm on each wheel.
class WheelNoise
{
public:
  explicit WheelNoise(const TConfigurationTree& options);
  void Add(RandomStream& random, argos::CCI_DifferentialSteeringSensor::SReading& reading) const;

private:
  struct Range
  {
    double low = 0;
    double high = 0;
  };
  Range speed_, distance_;
};

}  // namespace swarmanoid::argos3
