// A controller that shows the bits of every function of <cmath> and <complex>: the colours of its LEDs are a hash over
// them, and each step writes that hash as a line of the file <digests>. What runs it need not be our program: the hash
// of a step is also outside_mathematics_digest of the library.
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "ci_controller.h"
#include "footbot/ci_footbot_leds_actuator.h"

namespace
{

class Digest
{
public:
  void Add(double x) { AddBits(std::isnan(x) ? 1 : std::bit_cast<std::uint64_t>(x)); }
  void Add(float x) { Add(static_cast<double>(x)); }
  // Adds the part of the number that fits a double, and the rest.
  void Add(long double x)
  {
    Add(static_cast<double>(x));
    Add(std::isfinite(static_cast<double>(x)) ? static_cast<double>(x - static_cast<double>(x)) : 0.0);
  }
  template <class Number>
  void Add(const std::complex<Number>& z)
  {
    Add(z.real());
    Add(z.imag());
  }
  void Add(long long x) { AddBits(static_cast<std::uint64_t>(x)); }
  std::uint64_t Value() const { return value_; }

private:
  void AddBits(std::uint64_t bits) { value_ = (value_ ^ bits) * 1099511628211ULL; }
  std::uint64_t value_ = 14695981039346656037ULL;
};

template <class Number>
void AddFunctions(Digest& digest, Number x, Number y)
{
  for (const Number result :
       {std::sin(x),         std::cos(x),          std::tan(x),          std::asin(x),
        std::acos(x),        std::atan(x),         std::sinh(x),         std::cosh(x),
        std::tanh(x),        std::asinh(x),        std::acosh(x),        std::atanh(x),
        std::exp(x),         std::exp2(x),         std::expm1(x),        std::log(x),
        std::log2(x),        std::log10(x),        std::log1p(x),        std::cbrt(x),
        std::sqrt(x),        std::erf(x),          std::erfc(x),         std::lgamma(x),
        std::tgamma(x),      std::floor(x),        std::ceil(x),         std::trunc(x),
        std::round(x),       std::rint(x),         std::nearbyint(x),    std::fabs(x),
        std::logb(x),        std::pow(x, y),       std::atan2(x, y),     std::hypot(x, y),
        std::fmod(x, y),     std::remainder(x, y), std::fdim(x, y),      std::fmax(x, y),
        std::fmin(x, y),     std::copysign(x, y),  std::nextafter(x, y), std::fma(x, y, x),
        std::hypot(x, y, x), std::ldexp(x, 3),     std::scalbn(x, -3),   std::lerp(x, y, static_cast<Number>(0.3))})
    digest.Add(result);
  int number = 0;
  digest.Add(std::frexp(x, &number));
  digest.Add(std::remquo(x, y, &number));
  Number whole = 0;
  digest.Add(std::modf(x, &whole));
  digest.Add(whole);
  if (std::fabs(x) < 1e15) digest.Add(static_cast<long long>(std::llrint(x)));
}

template <class Number>
void AddComplexFunctions(Digest& digest, Number x, Number y)
{
  const std::complex<Number> z(x, y);
  for (const auto& result :
       {std::exp(z), std::log(z), std::log10(z), std::sqrt(z), std::sin(z), std::cos(z), std::tan(z), std::sinh(z),
        std::cosh(z), std::tanh(z), std::asin(z), std::acos(z), std::atan(z), std::asinh(z), std::acosh(z),
        std::atanh(z), std::pow(z, z), std::pow(z, x), std::polar(std::fabs(x), y)})
    digest.Add(result);
  digest.Add(std::abs(z));
  digest.Add(std::arg(z));
}

// The special functions of mathematics, within their domains.
template <class Number>
void AddSpecialFunctions(Digest& digest, Number x)
{
  const Number share = x / 10;
  for (const Number result : {std::assoc_laguerre(2U, 1U, x),
                              std::assoc_legendre(3U, 1U, share),
                              std::beta(x, share + 1),
                              std::comp_ellint_1(share),
                              std::comp_ellint_2(share),
                              std::comp_ellint_3(share, share),
                              std::cyl_bessel_i(share, x),
                              std::cyl_bessel_j(share, x),
                              std::cyl_bessel_k(share, x),
                              std::cyl_neumann(share, x),
                              std::ellint_1(share, x),
                              std::ellint_2(share, x),
                              std::ellint_3(share, share, x),
                              std::expint(x),
                              std::hermite(3U, x),
                              std::laguerre(3U, x),
                              std::legendre(3U, share),
                              std::riemann_zeta(x + 1),
                              std::sph_bessel(2U, x),
                              std::sph_legendre(2U, 1U, x),
                              std::sph_neumann(2U, x)})
    digest.Add(result);
}

// Equal for equal steps.
std::uint64_t DigestOf(std::uint64_t step)
{
  Digest digest;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // The numbers are known only at run time, since the compiler evaluates constants.
  static volatile const double specials[] = {0.0,    -0.0,      1.0,        -1.0,         0.5,   -2.5,
                                             1e22,   -1e300,    5e-324,     1e-310,       1e-8,  709.7,
                                             -745.0, kInfinity, -kInfinity, std::nan(""), 171.5, 3.0};
  for (const volatile double& x : specials)
    for (const volatile double& y : specials)
    {
      AddFunctions<double>(digest, x, y);
      AddFunctions<float>(digest, static_cast<float>(x), static_cast<float>(y));
    }
  std::mt19937_64 random(step);
  const auto between = [&random](double low, double high)
  { return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < 2000; ++i)
  {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 40) - 20);
    const double x = between(-10, 10) * scale;
    const double y = between(-10, 10);
    AddFunctions<double>(digest, x, y);
    AddFunctions<float>(digest, static_cast<float>(x), static_cast<float>(y));
    if (i >= 20) continue;
    AddFunctions<long double>(digest, x, y);
    AddComplexFunctions<double>(digest, between(-3, 3), between(-3, 3));
    AddComplexFunctions<float>(digest, static_cast<float>(between(-3, 3)), static_cast<float>(between(-3, 3)));
    AddSpecialFunctions<double>(digest, between(0.1, 9.5));
    AddSpecialFunctions<float>(digest, static_cast<float>(between(0.1, 9.5)));
  }
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> exponential;
  std::gamma_distribution<double> gamma(0.7);
  for (int i = 0; i < 100; ++i)
  {
    digest.Add(normal(random));
    digest.Add(exponential(random));
    digest.Add(gamma(random));
  }
  return digest.Value();
}

}  // namespace

extern "C" std::uint64_t outside_mathematics_digest(std::uint64_t step) { return DigestOf(step); }

class COutsideMathematics : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    leds_ = &GetRobot()->Actuator<CCI_FootBotLedsActuator>("footbot_leds");
    digests_ = t_tree.GetText("digests", "");
    return RETURN_OK;
  }

  void ControlStep() override
  {
    const std::uint64_t digest = DigestOf(GetRobot()->GetTick());
    for (unsigned led = 0; led < CCI_FootBotLedsActuator::NUM_LEDS; ++led)
      leds_->SetColour(led, static_cast<std::uint32_t>(digest >> (led * 3 % 41)) & 0xffffffU);
    if (digests_.empty()) return;
    std::FILE* const file = std::fopen(digests_.c_str(), "a");
    if (file == nullptr) throw std::runtime_error("cannot write " + digests_);
    std::fprintf(file, "%016llx\n", static_cast<unsigned long long>(digest));
    std::fclose(file);
  }

private:
  CCI_FootBotLedsActuator* leds_ = nullptr;
  std::string digests_;
};

REGISTER_CONTROLLER(COutsideMathematics, "outside_mathematics")
