#include "argos3/plugin/device_noise.h"

#include "common/math/elementary.h"

namespace swarmanoid::argos3
{

void DisturbDirection(RandomStream& random, double deviation_m, Vector3& to_sender)
{
  if (deviation_m <= 0) return;
  const double length = random.Gaussian(0, deviation_m);
  const SinCos inclination = SinCosOf(random.Uniform(0, kPi));
  const SinCos azimuth = SinCosOf(random.Uniform(0, 2 * kPi));
  to_sender += length * Vector3(inclination.sin * azimuth.cos, inclination.sin * azimuth.sin, inclination.cos);
}

void DisturbBlob(RandomStream& random, double deviation, double& distance, double& angle_rad)
{
  if (deviation <= 0) return;
  const double length = distance * random.Gaussian(0, deviation);
  const SinCos towards = SinCosOf(random.Uniform(0, 2 * kPi));
  const SinCos angle = SinCosOf(angle_rad);
  const Vector2 place = distance * Vector2(angle.cos, angle.sin) + length * Vector2(towards.cos, towards.sin);
  distance = place.norm();
  angle_rad = Atan2(place.y(), place.x());
}

WheelNoise::WheelNoise(const TConfigurationTree& options)
    : speed_{options.GetNumber("speed_noise_low", 0), options.GetNumber("speed_noise_high", 0)},
      distance_{options.GetNumber("distance_noise_low", 0), options.GetNumber("distance_noise_high", 0)}
{
}

void WheelNoise::Add(RandomStream& random, argos::CCI_DifferentialSteeringSensor::SReading& reading) const
{
  const auto disturb = [&](const Range& range, Real& value)
  {
    if (range.low < range.high) value += random.Uniform(range.low, range.high);
  };
  disturb(speed_, reading.VelocityLeftWheel);
  disturb(speed_, reading.VelocityRightWheel);
  disturb(distance_, reading.CoveredDistanceLeftWheel);
  disturb(distance_, reading.CoveredDistanceRightWheel);
}

}  // namespace swarmanoid::argos3
