// Random numbers and the noise of devices need quantiles of the normal distribution: fast, for many numbers, and with
// the same bits on every processor. NormalQuantile is the algorithm AS 241 (M. J. Wichura, "The percentage points of
// the normal distribution", Applied Statistics 37(3), 1988), which has a rational approximation for each of three
// ranges. NormalQuantiles first takes all numbers as if they were in the middle range, without branches, and then
// computes the rare others again. NormalMass sums the series of G. Marsaglia, "Evaluating the normal distribution",
// Journal of Statistical Software 11(4), 2004.
//
// Invariant: both forms do the same operations for a number, so the grouping into lanes changes no bit.
#include "common/math/normal.h"

#include <algorithm>
#include <array>

#include "common/math/elementary.h"
#include "common/math/lanes.h"

namespace swarmanoid
{
namespace
{

// These are the coefficients of AS 241, PPND16: rational approximations of the middle, the flanks and the far tails,
// highest power first.
constexpr std::array kMiddleNumerator{2.5090809287301226727e3, 3.3430575583588128105e4, 6.7265770927008700853e4,
                                      4.5921953931549871457e4, 1.3731693765509461125e4, 1.9715909503065514427e3,
                                      1.3314166789178437745e2, 3.3871328727963666080};
constexpr std::array kMiddleDenominator{
    5.2264952788528545610e3, 2.8729085735721942674e4, 3.9307895800092710610e4, 2.1213794301586595867e4,
    5.3941960214247511077e3, 6.8718700749205790830e2, 4.2313330701600911252e1, 1.0};
constexpr std::array kFlankNumerator{7.74545014278341407640e-4, 2.27238449892691845833e-2, 2.41780725177450611770e-1,
                                     1.27045825245236838258,    3.64784832476320460504,    5.76949722146069140550,
                                     4.63033784615654529590,    1.42343711074968357734};
constexpr std::array kFlankDenominator{
    1.05075007164441684324e-9, 5.47593808499534494600e-4, 1.51986665636164571966e-2, 1.48103976427480074590e-1,
    6.89767334985100004550e-1, 1.67638483018380384940,    2.05319162663775882187,    1.0};
constexpr std::array kTailNumerator{2.01033439929228813265e-7, 2.71155556874348757815e-5, 1.24266094738807843860e-3,
                                    2.65321895265761230930e-2, 2.96560571828504891230e-1, 1.78482653991729133580,
                                    5.46378491116411436990,    6.65790464350110377720};
constexpr std::array kTailDenominator{
    2.04426310338993978564e-15, 1.42151175831644588870e-7, 1.84631831751005468180e-5, 7.86869131145613259100e-4,
    1.48753612908506148525e-2,  1.36929880922735805310e-1, 5.99832206555887937690e-1, 1.0};

constexpr double kMiddle = 0.425;

template <class Number>
inline Number Quotient(const std::array<double, 8>& numerator, const std::array<double, 8>& denominator, Number r)
{
  Number above = numerator[0] - Number{};
  Number below = denominator[0] - Number{};
  for (std::size_t i = 1; i < 8; ++i)
  {
    above = above * r + numerator[i];
    below = below * r + denominator[i];
  }
  return above / below;
}

// Returns the same bits as Log, for normal numbers above 0.
DoubleLanes LogOf(DoubleLanes x)
{
  const auto bits = reinterpret_cast<LongLanes>(x);
  // The exponent is placed behind 2^52 as a double.
  DoubleLanes exponent = reinterpret_cast<DoubleLanes>(bits >> 52 | 0x4330000000000000) - 0x1p52 - 1023.0;
  DoubleLanes mantissa = reinterpret_cast<DoubleLanes>((bits & 0xfffffffffffff) | 0x3ff0000000000000);
  const auto is_large = mantissa > 1.4142135623730951;
  mantissa = is_large ? mantissa * 0.5 : mantissa;
  exponent = is_large ? exponent + 1.0 : exponent;
  const DoubleLanes s = (mantissa - 1.0) / (mantissa + 1.0);
  const DoubleLanes z = s * s;
  DoubleLanes p = Everywhere(1.0 / 21.0);
  for (int k = 19; k >= 3; k -= 2) p = p * z + 1.0 / k;
  return exponent * 6.93147180369123816490e-01 + (2.0 * s + (2.0 * s * z * p + exponent * 1.90821492927058770002e-10));
}

// Returns the quantiles of masses beyond the middle.
DoubleLanes FlankQuantiles(DoubleLanes mass)
{
  const DoubleLanes away = mass < 0 ? -mass : mass;
  const DoubleLanes r = SquareRoot(-LogOf(0.5 - away));
  DoubleLanes x = Quotient(kFlankNumerator, kFlankDenominator, r - 1.6);
  x = mass < 0 ? -x : x;
  // The far tails, and the numbers that Log treats specially, are so rare that they are computed one by one.
  ForEachBit(LaneMask(~(r <= 5.0)), [&](unsigned lane) { x[lane] = NormalQuantile(mass[lane]); });
  return x;
}

}  // namespace

double NormalQuantile(double mass)
{
  const double away = __builtin_fabs(mass);
  if (away <= kMiddle) return mass * Quotient(kMiddleNumerator, kMiddleDenominator, kMiddle * kMiddle - mass * mass);
  const double r = __builtin_sqrt(-Log(0.5 - away));
  const double x = r <= 5 ? Quotient(kFlankNumerator, kFlankDenominator, r - 1.6)
                          : Quotient(kTailNumerator, kTailDenominator, r - 5);
  return mass < 0 ? -x : x;
}

void NormalQuantiles(std::span<double> masses)
{
  // All masses are computed as if they were in the middle; then those outside are computed again.
  constexpr std::size_t kBlock = 256;
  std::array<double, kBlock + kDoubleLanes> flanks;
  std::array<std::uint32_t, kBlock + 1> places;
  const std::size_t whole = masses.size() / kDoubleLanes * kDoubleLanes;
  for (std::size_t begin = 0; begin < whole; begin += kBlock)
  {
    const std::size_t end = std::min(begin + kBlock, whole);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; i += kDoubleLanes)
    {
      const DoubleLanes mass = LoadLanes(&masses[i]);
      // The mask avoids a branch, which the processor could not predict.
      const unsigned mask = LaneMask((mass > kMiddle) | (mass < -kMiddle));
      for (unsigned lane = 0; lane < kDoubleLanes; ++lane)
      {
        flanks[count] = masses[i + lane];
        places[count] = static_cast<std::uint32_t>(i + lane - begin);
        count += mask >> lane & 1;
      }
      StoreLanes(mass * Quotient(kMiddleNumerator, kMiddleDenominator, kMiddle * kMiddle - mass * mass), &masses[i]);
    }
    for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) flanks[count + lane] = kMiddle;
    for (std::size_t i = 0; i < count; i += kDoubleLanes)
    {
      const DoubleLanes x = FlankQuantiles(LoadLanes(&flanks[i]));
      for (std::size_t lane = 0; lane < std::min<std::size_t>(kDoubleLanes, count - i); ++lane)
        masses[begin + places[i + lane]] = x[lane];
    }
  }
  for (std::size_t i = whole; i < masses.size(); ++i) masses[i] = NormalQuantile(masses[i]);
}

double NormalMass(double x)
{
  constexpr double kRootOfTwoPi = 2.50662827463100050242;
  if (x > 8.5) return 0.5;  // the rest is below the last bit
  const double square = x * x;
  double term = x;
  double sum = x;
  for (double power = 3; term > 1e-17 * sum; power += 2) sum += term *= square / power;
  return std::min(sum * Exp(-0.5 * square) / kRootOfTwoPi, 0.5);
}

}  // namespace swarmanoid
