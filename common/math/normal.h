// The normal distribution with the same bits on every processor, on the functions of elementary.h. Used by random
// numbers and by the noise of devices.
#pragma once

#include <span>

namespace swarmanoid
{

// The x with Phi(x) = 1/2 + mass: the standard normal distribution inverted about its middle. |mass| must be below 1/2.
// Relative error below 1e-15 (Wichura, "The percentage points of the normal distribution", algorithm AS 241, 1988).
double NormalQuantile(double mass);
// In place, the same bits, several at a time.
void NormalQuantiles(std::span<double> masses);

// Phi(x) - 1/2, the mass between 0 and x; x must not be negative. Relative error below 1e-14 (the series of Marsaglia,
// "Evaluating the normal distribution", 2004). Takes up to 200 steps: for tables, not for inner loops.
double NormalMass(double x);

}  // namespace swarmanoid
