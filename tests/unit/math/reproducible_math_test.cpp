// The functions of libm that this process finds: that they are ours, how precise they are, that their special values
// are those of IEEE 754, and that their bits never change. Reference: libquadmath, or long double, of 113 bits.
#include "common/math/reproducible_math.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <math.h>

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/math/random.h"
#if __LDBL_MANT_DIG__ == 113
// C++ does not declare them.
extern "C"
{
  __extension__ typedef _Complex long double ComplexQuad;
  ComplexQuad cexpl(ComplexQuad);
  ComplexQuad clogl(ComplexQuad);
  ComplexQuad csqrtl(ComplexQuad);
  ComplexQuad csinl(ComplexQuad);
  ComplexQuad ctanhl(ComplexQuad);
  ComplexQuad cacosl(ComplexQuad);
  ComplexQuad catanhl(ComplexQuad);
  long double cabsl(ComplexQuad);
}
#else
#include <quadmath.h>
#endif
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace swarmanoid
{
namespace
{

#if __LDBL_MANT_DIG__ == 113
typedef long double Quad;
#define WIDE(name) ::name##l
#else
__extension__ typedef __float128 Quad;
typedef __complex128 ComplexQuad;
#define WIDE(name) ::name##q
#endif

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

// The arguments of a check: evenly spread, or so that every power of two comes as often.
enum class Spread
{
  kEven,
  kPowers,
  kPowersOfBothSigns
};

// The first line of each function has the bounds of docs/determinism.md, in units in the last place.
struct Function
{
  const char* name;
  double (*function)(double);
  float (*of_float)(float);
  Quad (*reference)(Quad);
  double bound;
  double float_bound;
  Spread spread;
  double low, high;
};

Quad Exp10Reference(Quad x) { return WIDE(pow)(10, x); }

constexpr auto kEven = Spread::kEven;
constexpr auto kPowers = Spread::kPowers;
constexpr auto kBoth = Spread::kPowersOfBothSigns;

const Function kFunctions[] = {
    {"sin", ::sin, ::sinf, WIDE(sin), 0.85, 0.52, kEven, -100, 100},
    {"sin", ::sin, ::sinf, WIDE(sin), 0.85, 0.52, kBoth, 1e-300, 1e300},
    {"cos", ::cos, ::cosf, WIDE(cos), 0.85, 0.52, kEven, -100, 100},
    {"cos", ::cos, ::cosf, WIDE(cos), 0.85, 0.52, kBoth, 1e-300, 1e300},
    {"tan", ::tan, ::tanf, WIDE(tan), 0.95, 0.9, kEven, -100, 100},
    {"tan", ::tan, ::tanf, WIDE(tan), 0.95, 0.9, kBoth, 1e-300, 1e300},
    {"asin", ::asin, ::asinf, WIDE(asin), 0.9, 0.9, kEven, -1, 1},
    {"acos", ::acos, ::acosf, WIDE(acos), 0.95, 0.95, kEven, -1, 1},
    {"atan", ::atan, ::atanf, WIDE(atan), 0.9, 0.9, kBoth, 1e-10, 1e10},
    {"sinh", ::sinh, ::sinhf, WIDE(sinh), 2.1, 2.1, kEven, -20, 20},
    {"sinh", ::sinh, ::sinhf, WIDE(sinh), 2.1, 2.1, kBoth, 1e-5, 710},
    {"cosh", ::cosh, ::coshf, WIDE(cosh), 1.5, 1.5, kEven, -700, 700},
    {"tanh", ::tanh, ::tanhf, WIDE(tanh), 2.3, 2.3, kEven, -20, 20},
    {"tanh", ::tanh, ::tanhf, WIDE(tanh), 2.3, 2.3, kBoth, 1e-10, 10},
    {"asinh", ::asinh, ::asinhf, WIDE(asinh), 1.9, 1.9, kEven, -4, 4},
    {"asinh", ::asinh, ::asinhf, WIDE(asinh), 1.9, 1.9, kBoth, 1e-10, 1e300},
    {"acosh", ::acosh, ::acoshf, WIDE(acosh), 2.0, 2.0, kEven, 1, 4},
    {"acosh", ::acosh, ::acoshf, WIDE(acosh), 2.0, 2.0, kPowers, 1, 1e300},
    {"atanh", ::atanh, ::atanhf, WIDE(atanh), 1.9, 1.9, kEven, -0.999, 0.999},
    {"atanh", ::atanh, ::atanhf, WIDE(atanh), 1.9, 1.9, kBoth, 1e-10, 0.999},
    {"exp", ::exp, ::expf, WIDE(exp), 0.53, 0.51, kEven, -708, 709},
    {"exp2", ::exp2, ::exp2f, WIDE(exp2), 0.53, 0.51, kEven, -1022, 1023},
    {"exp10", ::exp10, ::exp10f, Exp10Reference, 0.55, 0.51, kEven, -300, 300},
    {"expm1", ::expm1, ::expm1f, WIDE(expm1), 1.0, 1.0, kEven, -40, 700},
    {"expm1", ::expm1, ::expm1f, WIDE(expm1), 1.0, 1.0, kBoth, 1e-10, 1},
    {"log", ::log, ::logf, WIDE(log), 0.53, 0.85, kPowers, 1e-300, 1e300},
    {"log", ::log, ::logf, WIDE(log), 0.53, 0.85, kEven, 0.5, 2},
    {"log2", ::log2, ::log2f, WIDE(log2), 0.56, 0.8, kPowers, 1e-300, 1e300},
    {"log2", ::log2, ::log2f, WIDE(log2), 0.56, 0.8, kEven, 0.5, 2},
    {"log10", ::log10, ::log10f, WIDE(log10), 0.75, 0.9, kPowers, 1e-300, 1e300},
    {"log10", ::log10, ::log10f, WIDE(log10), 0.75, 0.9, kEven, 0.5, 2},
    {"log1p", ::log1p, ::log1pf, WIDE(log1p), 0.95, 0.95, kEven, -0.99, 4},
    {"log1p", ::log1p, ::log1pf, WIDE(log1p), 0.95, 0.95, kPowers, 1e-10, 1e300},
    {"cbrt", ::cbrt, ::cbrtf, WIDE(cbrt), 0.7, 0.51, kBoth, 1e-300, 1e300},
    {"erf", ::erf, ::erff, WIDE(erf), 1.0, 1.0, kEven, -6, 6},
    {"erfc", ::erfc, ::erfcf, WIDE(erfc), 3.2, 3.2, kEven, -6, 9},
    {"erfc", ::erfc, ::erfcf, WIDE(erfc), 3.2, 3.2, kEven, 0, 26},
    {"lgamma", ::lgamma, ::lgammaf, WIDE(lgamma), 2.6, 2.6, kEven, 0.01, 100},
    {"lgamma", ::lgamma, ::lgammaf, WIDE(lgamma), 2.6, 2.6, kPowers, 1e-10, 1e300},
    {"lgamma", ::lgamma, ::lgammaf, WIDE(lgamma), 2.6, 2.6, kEven, -20, 0},
    {"tgamma", ::tgamma, ::tgammaf, WIDE(tgamma), 10, 0.51, kEven, 0.01, 171},
    {"tgamma", ::tgamma, ::tgammaf, WIDE(tgamma), 10, 0.51, kEven, -20, 0},
};

struct FunctionOfTwo
{
  const char* name;
  double (*function)(double, double);
  float (*of_float)(float, float);
  Quad (*reference)(Quad, Quad);
  double bound;
  double float_bound;
  double x_low, x_high, y_low, y_high;
};

const FunctionOfTwo kFunctionsOfTwo[] = {
    {"atan2", ::atan2, ::atan2f, WIDE(atan2), 1.6, 1.6, -10, 10, -10, 10},
    {"pow", ::pow, ::powf, WIDE(pow), 0.55, 0.85, 0, 10, -20, 20},
    {"pow", ::pow, ::powf, WIDE(pow), 0.55, 0.85, 0.9, 1.1, -700, 700},
    {"hypot", ::hypot, ::hypotf, WIDE(hypot), 1.0, 1.0, -10, 10, -10, 10},
    {"hypot", ::hypot, ::hypotf, WIDE(hypot), 1.0, 1.0, -1e300, 1e300, -1e299, 1e299},
};

constexpr int kArguments = 1500;

double Argument(RandomStream& random, Spread spread, double low, double high)
{
  const double share = random.Uniform();
  if (spread == Spread::kEven) return low + (high - low) * share;
  const double size =
      static_cast<double>(WIDE(exp)(WIDE(log)(low) + (WIDE(log)(high) - WIDE(log)(low)) * static_cast<Quad>(share)));
  return spread == Spread::kPowersOfBothSigns && random.Bits() % 2 == 0 ? -size : size;
}

// The error in units in the last place of the right result; 0 if that is no normal number.
template <class Number>
double Error(Number result, Quad right)
{
  const Quad size = WIDE(fabs)(right);
  if (!(size <= static_cast<Quad>(std::numeric_limits<Number>::max()))) return 0;
  if (size < static_cast<Quad>(std::numeric_limits<Number>::min())) return 0;
  if (!std::isfinite(result)) return kInfinite;
  int exponent = 0;
  WIDE(frexp)(size, &exponent);
  return static_cast<double>(WIDE(fabs)(static_cast<Quad>(result) - right) /
                             WIDE(ldexp)(1, exponent - std::numeric_limits<Number>::digits));
}

std::string FileOf(const void* function)
{
  Dl_info place{};
  return dladdr(function, &place) != 0 ? place.dli_fname : "";
}

TEST(ReproducibleMath, ComesBeforeLibm)
{
  EXPECT_NO_THROW(RequireReproducibleMath());
  const std::string library = "libswarmanoid_reproducible_math.so";
  for (const char* name :
       {"sin",    "cosf",   "tanl",   "atan2", "exp",   "exp2f", "pow",    "powf",   "log",    "hypot",
        "lgamma", "tgamma", "sincos", "cexp",  "cpowf", "expl",  "cacosl", "sinf64", "powf32", "lgamma_r"})
  {
#if __LDBL_MANT_DIG__ == 113
    if (const std::string text = name; text == "tanl" || text == "expl" || text == "cacosl") continue;  // libm's own
#endif
    // Sanitizers intercept these functions, and call ours.
    if (FileOf(dlsym(RTLD_DEFAULT, name)).find("san.so") != std::string::npos) continue;
    void* const own = dlvsym(RTLD_DEFAULT, name, "SWARMANOID_1");
    const bool only_for_others =
        std::string(name).find("f64") != std::string::npos || std::string(name).find("f32") != std::string::npos;
    EXPECT_EQ(own == nullptr, only_for_others) << name;
    // Code that is linked against libm finds all versions of its symbols in our library.
    void* const libm = dlopen("libm.so.6", RTLD_NOW | RTLD_NOLOAD);
    ASSERT_NE(libm, nullptr);
    int versions = 0;
    for (const char* version : {"GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.23", "GLIBC_2.27", "GLIBC_2.29", "GLIBC_2.35"})
    {
      if (dlvsym(libm, name, version) == nullptr) continue;
      ++versions;
      EXPECT_NE(FileOf(dlvsym(RTLD_DEFAULT, name, version)).find(library), std::string::npos) << name << version;
    }
    EXPECT_GT(versions, 0) << name;
    dlclose(libm);
  }
}

TEST(ReproducibleMath, RefusesOtherModes)
{
  const FloatingPointGuard guard;
  std::fesetround(FE_UPWARD);
  EXPECT_THROW(RequireReproducibleMath(), std::runtime_error);
  std::fesetround(FE_TONEAREST);
  EXPECT_NO_THROW(RequireReproducibleMath());
#ifdef __SSE__
  _mm_setcsr(_mm_getcsr() | _MM_FLUSH_ZERO_ON);
  EXPECT_THROW(RequireReproducibleMath(), std::runtime_error);
#endif
}

TEST(ReproducibleMath, FunctionsOfOneNumberKeepTheirErrorBounds)
{
  RandomStream random(1, 2, 3, 4);
  for (const Function& f : kFunctions)
  {
    double worst = 0;
    double worst_of_float = 0;
    for (int i = 0; i < kArguments; ++i)
    {
      const double x = Argument(random, f.spread, f.low, f.high);
      worst = std::max(worst, Error(f.function(x), f.reference(x)));
      const auto rounded = static_cast<float>(x);
      if (!std::isfinite(rounded)) continue;
      worst_of_float = std::max(worst_of_float, Error(f.of_float(rounded), f.reference(rounded)));
    }
    EXPECT_LE(worst, f.bound) << f.name << " from " << f.low << " to " << f.high;
    EXPECT_LE(worst_of_float, f.float_bound) << f.name << "f from " << f.low << " to " << f.high;
  }
}

TEST(ReproducibleMath, FunctionsOfTwoNumbersKeepTheirErrorBounds)
{
  RandomStream random(5, 6, 7, 8);
  for (const FunctionOfTwo& f : kFunctionsOfTwo)
  {
    double worst = 0;
    double worst_of_float = 0;
    for (int i = 0; i < kArguments; ++i)
    {
      const double x = random.Uniform(f.x_low, f.x_high);
      const double y = random.Uniform(f.y_low, f.y_high);
      worst = std::max(worst, Error(f.function(x, y), f.reference(x, y)));
      const auto xf = static_cast<float>(x);
      const auto yf = static_cast<float>(y);
      if (!std::isfinite(xf) || !std::isfinite(yf)) continue;
      worst_of_float = std::max(worst_of_float, Error(f.of_float(xf, yf), f.reference(xf, yf)));
    }
    EXPECT_LE(worst, f.bound) << f.name;
    EXPECT_LE(worst_of_float, f.float_bound) << f.name << "f";
  }
}

TEST(ReproducibleMath, ComplexNumbersAndLongDoublesArePrecise)
{
  RandomStream random(9, 10, 11, 12);
  using Complex = std::complex<double>;
  struct OfComplex
  {
    const char* name;
    Complex (*function)(const Complex&);
    ComplexQuad (*reference)(ComplexQuad);
  };
  const OfComplex functions[] = {{"exp", std::exp<double>, WIDE(cexp)},      {"log", std::log<double>, WIDE(clog)},
                                 {"sqrt", std::sqrt<double>, WIDE(csqrt)},   {"sin", std::sin<double>, WIDE(csin)},
                                 {"tanh", std::tanh<double>, WIDE(ctanh)},   {"acos", std::acos<double>, WIDE(cacos)},
                                 {"atanh", std::atanh<double>, WIDE(catanh)}};
  for (const OfComplex& f : functions)
    for (int i = 0; i < kArguments / 2; ++i)
    {
      const Complex z(random.Uniform(-3, 3), random.Uniform(-3, 3));
      ComplexQuad wide;
      __real__ wide = z.real();
      __imag__ wide = z.imag();
      wide = f.reference(wide);
      const Complex result = f.function(z);
      const Quad error = WIDE(hypot)(result.real() - __real__ wide, result.imag() - __imag__ wide) / WIDE(cabs)(wide);
      EXPECT_LE(static_cast<double>(error), 6 * 0x1p-53) << f.name << z;
    }
  long double (*const of_long_double[])(long double) = {::sinl, ::expl, ::logl, ::tanhl, ::erfl};
  Quad (*const references[])(Quad) = {WIDE(sin), WIDE(exp), WIDE(log), WIDE(tanh), WIDE(erf)};
  for (int i = 0; i < kArguments / 2; ++i)
    for (int f = 0; f < 5; ++f)
    {
      const long double x = random.Uniform(0, 20);
      EXPECT_LE(Error(of_long_double[f](x), references[f](x)), 0.51) << f;
    }
}

TEST(ReproducibleMath, SpecialValuesAreThoseOfTheStandard)
{
  struct OfOne
  {
    double (*function)(double);
    double argument;
    double result;
  };
  const OfOne ones[] = {
      {::sin, -0.0, -0.0},
      {::sin, kInfinite, kNan},
      {::sin, kSmallest, kSmallest},
      {::sin, 1e22, -0.8522008497671888},
      {::cos, 1e22, 0.52321478539513895},
      {::cos, -kInfinite, kNan},
      {::tan, -0.0, -0.0},
      {::asin, 1.0000000000000002, kNan},
      {::asin, -0.0, -0.0},
      {::acos, 1, 0},
      {::acos, -2, kNan},
      {::atan, kInfinite, 0x1.921fb54442d18p+0},
      {::sinh, -kInfinite, -kInfinite},
      {::cosh, -kInfinite, kInfinite},
      {::tanh, -kInfinite, -1},
      {::tanh, -0.0, -0.0},
      {::asinh, -kInfinite, -kInfinite},
      {::acosh, 0.5, kNan},
      {::acosh, 1, 0},
      {::atanh, -1, -kInfinite},
      {::atanh, 2, kNan},
      {::exp, -kInfinite, 0},
      {::exp, 710, kInfinite},
      {::exp, -746, 0},
      {::exp, -745, kSmallest},
      {::exp2, -1074, kSmallest},
      {::exp2, 1024, kInfinite},
      {::exp10, 22, 1e22},
      {::exp10, -400, 0},
      {::expm1, -kInfinite, -1},
      {::expm1, -0.0, -0.0},
      {::log, -0.0, -kInfinite},
      {::log, -1, kNan},
      {::log, 1, 0},
      {::log, kInfinite, kInfinite},
      {::log2, 8, 3},
      {::log2, kSmallest, -1074},
      {::log10, 1000, 3},
      {::log10, 0, -kInfinite},
      {::log1p, -1, -kInfinite},
      {::log1p, -0.0, -0.0},
      {::cbrt, -27, -3},
      {::cbrt, -0.0, -0.0},
      {::erf, kInfinite, 1},
      {::erfc, -kInfinite, 2},
      {::erfc, 30, 0},
      {::lgamma, 1, 0},
      {::lgamma, -3, kInfinite},
      {::lgamma, -kInfinite, kInfinite},
      {::tgamma, 5, 24},
      {::tgamma, -1, kNan},
      {::tgamma, -0.0, -kInfinite},
      {::tgamma, 172, kInfinite},
      {::exp, kNan, kNan},
      {::lgamma, kNan, kNan},
  };
  int line = 0;
  for (const OfOne& one : ones)
  {
    const double result = one.function(one.argument);
    if (std::isnan(one.result))
      EXPECT_TRUE(std::isnan(result)) << line << ": " << one.argument;
    else
      EXPECT_EQ(std::bit_cast<std::uint64_t>(result), std::bit_cast<std::uint64_t>(one.result))
          << line << ": " << one.argument << " gives " << result;
    ++line;
  }
  struct OfTwo
  {
    double (*function)(double, double);
    double x, y;
    double result;
  };
  const OfTwo twos[] = {
      {::atan2, 0, -0.0, 0x1.921fb54442d18p+1},
      {::atan2, -0.0, 1, -0.0},
      {::atan2, 0, 0, 0},
      {::atan2, -0.0, -0.0, -0x1.921fb54442d18p+1},
      {::atan2, kInfinite, -kInfinite, 0x1.2d97c7f3321d2p+1},
      {::pow, kNan, 0, 1},
      {::pow, 1, kNan, 1},
      {::pow, -2, 3, -8},
      {::pow, -2, 0.5, kNan},
      {::pow, 0, -3, kInfinite},
      {::pow, -0.0, -3, -kInfinite},
      {::pow, -1, kInfinite, 1},
      {::pow, 0.5, -kInfinite, kInfinite},
      {::pow, 10, 22, 1e22},
      {::pow, 2, -1074, kSmallest},
      {::hypot, kInfinite, kNan, kInfinite},
      {::hypot, 0x3p600, 0x4p600, 0x5p600},
      {::hypot, kSmallest, 0, kSmallest},
  };
  line = 0;
  for (const OfTwo& two : twos)
  {
    const double result = two.function(two.x, two.y);
    if (std::isnan(two.result))
      EXPECT_TRUE(std::isnan(result)) << line;
    else
      EXPECT_EQ(std::bit_cast<std::uint64_t>(result), std::bit_cast<std::uint64_t>(two.result))
          << line << ": " << two.x << ", " << two.y << " gives " << result;
    ++line;
  }
  for (const double x : {-2.5, -3.5, 0.5, -0.0, 3.0})
  {
    int sign = 0;
    lgamma_r(x, &sign);
    EXPECT_EQ(sign, std::tgamma(x) < 0 ? -1 : 1) << x;
  }
}

// The compiler joins sin and cos of one argument to a call of sincos.
TEST(ReproducibleMath, SineAndCosineTogetherAreThoseApart)
{
  double (*const sine)(double) = ::sin;
  float (*const sine_of_float)(float) = ::sinf;
  RandomStream random(13, 14, 15, 16);
  for (int i = 0; i < kArguments; ++i)
  {
    const double x = Argument(random, Spread::kPowersOfBothSigns, 1e-10, 1e10);
    double s = 0, c = 0;
    ::sincos(x, &s, &c);
    ASSERT_EQ(s, sine(x));
    ASSERT_EQ(c, ::cos(x));
    float sf = 0, cf = 0;
    ::sincosf(static_cast<float>(x), &sf, &cf);
    ASSERT_EQ(sf, sine_of_float(static_cast<float>(x)));
  }
}

// Compares a hash over the results of every function. A change of it changes the results of experiments, so the
// changelog must mention it.
TEST(ReproducibleMath, HasTheBitsThatItAlwaysHad)
{
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211ULL; };
  const auto add_number = [&add](auto number)
  { add(std::isnan(number) ? 1 : std::bit_cast<std::uint64_t>(static_cast<double>(number))); };
  // Arguments from a generator that never changes (that of Lehmer, 1951, with the constants of Knuth's MMIX).
  std::uint64_t state = 1;
  const auto share_of = [&state]
  {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  const auto between = [&share_of](double low, double high) { return low + (high - low) * share_of(); };
  for (const Function& f : kFunctions)
    for (int i = 0; i < 500; ++i)
    {
      const double x = i % 2 == 0 ? between(f.low, f.high) : std::ldexp(between(-1, 1), i - 250);
      add_number(f.function(x));
      add_number(f.of_float(static_cast<float>(x)));
    }
  for (const FunctionOfTwo& f : kFunctionsOfTwo)
    for (int i = 0; i < 500; ++i)
    {
      const double x = between(f.x_low, f.x_high);
      const double y = between(f.y_low, f.y_high);
      add_number(f.function(x, y));
      add_number(f.of_float(static_cast<float>(x), static_cast<float>(y)));
    }
  for (int i = 0; i < 200; ++i)
  {
    // One after the other: compilers differ in the order of arguments.
    const double imaginary = between(-2, 2);
    const std::complex<double> z(between(-2, 2), imaginary);
    for (const auto& result : {std::exp(z), std::log(z), std::sqrt(z), std::tan(z), std::asin(z), std::pow(z, z)})
    {
      add_number(result.real());
      add_number(result.imag());
    }
  }
  EXPECT_EQ(hash, 0x729ee2d95e9ce5c6ULL);
}

}  // namespace
}  // namespace swarmanoid
