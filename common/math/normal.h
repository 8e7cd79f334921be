// The normal distribution with the same bits on every processor, based on the functions of elementary.h. Random numbers
// and the noise of devices use it.
#pragma once

#include <span>

namespace swarmanoid
{

// Returns the x with Phi(x) = 1/2 + mass: the inverse of the standard normal distribution about its middle. |mass| must
// be below 1/2. The relative error is below 1e-15 (Wichura, "The percentage points of the normal distribution",
// algorithm AS 241, 1988).
double NormalQuantile(double mass);
// Computes the same bits in place, several at a time.
void NormalQuantiles(std::span<double> masses);

// Returns Phi(x) - 1/2, the mass between 0 and x; x must not be negative. The relative error is below 1e-14 (the series
// of Marsaglia, "Evaluating the normal distribution", 2004). It takes up to 200 steps: use it for tables, not for inner
// loops.
double NormalMass(double x);

}  // namespace swarmanoid
