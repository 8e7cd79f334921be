// Problem: gusts with given spectra, the same for all processes, that need no state.
//
// Method: a sum of waves with random phases (M. Shinozuka and C.-M. Jan, "Digital simulation of random processes and
// its applications", Journal of Sound and Vibration 25, 1972). The spectrum is cut into bands of equal variance, and
// each wave has a random wave number within its band. With X = L k, the part of the variance below the wave number k is
//
//   along           2/π atan X                      (spectrum 2 σ² L/π / (1 + X²))
//   across, upwards 2/π atan X - X / (π (1 + X²))   (spectrum σ² L/π (1 + 3 X²) / (1 + X²)²)
//
// The waves drift with the mean wind (Taylor's hypothesis): their phase is k (x - U t) along its direction.
#include "common/space/wind.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

constexpr double kFoot = 0.3048;  // m

double Atan(double x) { return Atan2(x, 1); }

double ShareAlong(double x) { return 2 / kPi * Atan(x); }
double ShareAcross(double x) { return (2 * Atan(x) - x / (1 + x * x)) / kPi; }

// Returns the x at which an ascending share is reached. A share is that of atan x, so all are below 1e6 for the bands.
template <class Share>
double InverseOf(Share share, double wanted)
{
  double low = 0, high = 1e6;
  for (int step = 0; step < 80; ++step)
  {
    const double middle = (low + high) / 2;
    (share(middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

DrydenGusts DrydenGusts::At(double height_m, double wind_at_20_feet_m_s)
{
  const double feet = std::clamp(height_m / kFoot, 10.0, 1000.0);
  const double base = 0.177 + 0.000823 * feet;
  DrydenGusts gusts;
  gusts.upward_m_s = 0.1 * wind_at_20_feet_m_s;
  gusts.across_m_s = gusts.upward_m_s / Exp(0.4 * Log(base));
  gusts.upward_m = feet * kFoot;
  gusts.across_m = feet * kFoot / Exp(1.2 * Log(base));
  return gusts;
}

Wind::Wind(const Experiment& experiment)
{
  if (!experiment.wind) return;
  const WindConfiguration& given = *experiment.wind;
  is_declared_ = true;
  mean_ = given.velocity_m_s;
  speed_ = std::sqrt(mean_.head<2>().squaredNorm());
  if (speed_ > 0) direction_ = mean_.head<2>() / speed_;
  if (given.gusts_m_s == 0) return;
  const DrydenGusts gusts = DrydenGusts::At(given.height_m, given.gusts_m_s);
  const std::array<double, 3> deviation{gusts.across_m_s, gusts.across_m_s, gusts.upward_m_s};
  const std::array<double, 3> length{gusts.across_m, gusts.across_m, gusts.upward_m};
  const StreamKey key(experiment.seed, StreamName("<wind>"), StreamName("gusts"));
  for (std::size_t component = 0; component < 3; ++component)
  {
    RandomStream random(key, 0, component);
    amplitude_[component] = deviation[component] * std::sqrt(2.0 / kWaves);
    for (int wave = 0; wave < kWaves; ++wave)
    {
      const double share = (wave + random.Uniform()) / kWaves;
      const double x = component == 0 ? InverseOf(ShareAlong, share) : InverseOf(ShareAcross, share);
      waves_[component].push_back({x / length[component], random.Uniform(0, 2 * kPi)});
    }
  }
}

Vector3 Wind::At(const Vector3& place, double time_s) const
{
  const double along = place.head<2>().dot(direction_) - speed_ * time_s;
  std::array<double, 3> gust{};
  for (std::size_t component = 0; component < 3; ++component)
  {
    for (const Wave& wave : waves_[component]) gust[component] += Cos(wave.per_metre * along + wave.phase);
    gust[component] *= amplitude_[component];
  }
  return mean_ + Vector3(gust[0] * direction_.x() - gust[1] * direction_.y(),
                         gust[0] * direction_.y() + gust[1] * direction_.x(), gust[2]);
}

}  // namespace swarmanoid
