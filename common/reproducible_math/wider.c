// Functions of libm that musl lacks or computes coarsely, and those of long double, whose x87 instructions differ
// between makes of processors. GCC's libquadmath computes them with 113 bits in arithmetic made of integers; they are
// rounded once, and take some microseconds a call. Where long double has 113 bits itself (aarch64), libm's functions of
// long double are such arithmetic: they are used here, and stay libm's. Compiled without built-in functions: GCC would
// turn pow(10, x) within exp10 into exp10.
#define _GNU_SOURCE  // clog10l
#include <complex.h>
#if __LDBL_MANT_DIG__ == 113
#include <math.h>
typedef long double Wide;
#define WIDE(name) name##l
#else
#include <quadmath.h>
typedef __float128 Wide;
#define WIDE(name) name##q
#endif

double log(double x);
double hypot(double x, double y);
float hypotf(float x, float y);
double atan2(double y, double x);
float atan2f(float y, float x);
double pow(double x, double y);
// musl's, renamed.
double musl_lgamma_r(double x, int* sign);
float musl_lgammaf_r(float x, int* sign);
// libm's, which programs read.
extern int signgam;

#if __LDBL_MANT_DIG__ != 113
#define WIDER(name) \
  long double name##l(long double x) { return (long double)WIDE(name)(x); }
#define WIDER_OF_TWO(name) \
  long double name##l(long double x, long double y) { return (long double)WIDE(name)(x, y); }

WIDER(sin)
WIDER(cos)
WIDER(tan)
WIDER(asin)
WIDER(acos)
WIDER(atan)
WIDER(sinh)
WIDER(cosh)
WIDER(tanh)
WIDER(asinh)
WIDER(acosh)
WIDER(atanh)
WIDER(exp)
WIDER(exp2)
WIDER(expm1)
WIDER(log)
WIDER(log2)
WIDER(log10)
WIDER(log1p)
WIDER(cbrt)
WIDER(erf)
WIDER(erfc)
WIDER(tgamma)
WIDER_OF_TWO(atan2)
WIDER_OF_TWO(pow)
WIDER_OF_TWO(hypot)

long double exp10l(long double x) { return (long double)WIDE(pow)(10, x); }

void sincosl(long double x, long double* sine, long double* cosine)
{
  *sine = sinl(x);
  *cosine = cosl(x);
}
#endif

// The logarithm of the gamma function. musl's loses digits beside its zeros, which lie below 0.

static int GammaSign(Wide x)
{
  const Wide below = WIDE(floor)(x);
  const int odd = WIDE(fmod)(below, 2) != 0;
  return __builtin_signbit(x) != 0 && (x == 0 || (x != below && odd)) ? -1 : 1;
}

static int BesideZeros(double x) { return x < 0 && x > -4503599627370496.0 && x != __builtin_floor(x); }

double lgamma_r(double x, int* sign)
{
  if (!BesideZeros(x)) return musl_lgamma_r(x, sign);
  *sign = GammaSign(x);
  return (double)WIDE(lgamma)(x);
}

float lgammaf_r(float x, int* sign) { return BesideZeros(x) ? (float)lgamma_r(x, sign) : musl_lgammaf_r(x, sign); }

#if __LDBL_MANT_DIG__ != 113
long double lgammal_r(long double x, int* sign)
{
  *sign = GammaSign(x);
  return (long double)WIDE(lgamma)(x);
}
long double lgammal(long double x) { return lgammal_r(x, &signgam); }
#endif

double lgamma(double x) { return lgamma_r(x, &signgam); }
float lgammaf(float x) { return lgammaf_r(x, &signgam); }

// Double for float.

double exp10(double x) { return pow(10, x); }
float exp10f(float x) { return (float)pow(10, x); }

// Complex numbers. Those of float are computed in double, those of long double with 113 bits, like the inverse
// functions.

#if __LDBL_MANT_DIG__ == 113
#define COMPLEX_WIDER(name)
#else
#define COMPLEX_WIDER(name) \
  long double complex name##l(long double complex z) { return (long double complex)WIDE(name)(z); }
#endif
#define COMPLEX(name)                                                       \
  float complex name##f(float complex z) { return (float complex)name(z); } \
  COMPLEX_WIDER(name)
#define COMPLEX_INVERSE(name)                                                     \
  double complex name(double complex z) { return (double complex)WIDE(name)(z); } \
  COMPLEX(name)

double complex clog(double complex z)
{
  const double x = __real__ z;
  const double y = __imag__ z;
  double complex result;
  // The logarithm of a number beside 1 needs all digits of that number.
  const double size = hypot(x, y);
  __real__ result = size > 0.5 && size < 2 ? (double)(WIDE(log)((Wide)x * x + (Wide)y * y) / 2) : log(size);
  __imag__ result = atan2(y, x);
  return result;
}

COMPLEX(cexp)
COMPLEX(clog)
COMPLEX(csqrt)
COMPLEX(csin)
COMPLEX(ccos)
COMPLEX(ctan)
COMPLEX(csinh)
COMPLEX(ccosh)
COMPLEX(ctanh)
COMPLEX_INVERSE(clog10)
COMPLEX_INVERSE(casin)
COMPLEX_INVERSE(cacos)
COMPLEX_INVERSE(catan)
COMPLEX_INVERSE(casinh)
COMPLEX_INVERSE(cacosh)
COMPLEX_INVERSE(catanh)

double complex cpow(double complex x, double complex y) { return cexp(y * clog(x)); }
float complex cpowf(float complex x, float complex y) { return (float complex)cpow(x, y); }

double cabs(double complex z) { return hypot(__real__ z, __imag__ z); }
float cabsf(float complex z) { return hypotf(__real__ z, __imag__ z); }
double carg(double complex z) { return atan2(__imag__ z, __real__ z); }
float cargf(float complex z) { return atan2f(__imag__ z, __real__ z); }

#if __LDBL_MANT_DIG__ != 113
long double complex cpowl(long double complex x, long double complex y)
{
  return (long double complex)WIDE(cpow)(x, y);
}
long double cabsl(long double complex z) { return hypotl(__real__ z, __imag__ z); }
long double cargl(long double complex z) { return atan2l(__imag__ z, __real__ z); }
#endif
