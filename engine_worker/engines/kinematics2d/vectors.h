// Short vectors for the inner loops of the kinematic engine. The lane count follows the processor that the build is
// for; all operations work lane by lane, so that it never changes a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace swarmanoid::kinematics2d
{

#if defined(__AVX__)
inline constexpr std::size_t kVectorBytes = 32;
#else
inline constexpr std::size_t kVectorBytes = 16;
#endif

// Arrays that the inner loops read are padded to a multiple of this many elements.
inline constexpr std::size_t kPadding = 16;

using Doubles = double __attribute__((vector_size(kVectorBytes)));
using DoubleMask = std::int64_t __attribute__((vector_size(kVectorBytes)));
using Floats = float __attribute__((vector_size(kVectorBytes)));
using FloatMask = std::int32_t __attribute__((vector_size(kVectorBytes)));
inline constexpr std::size_t kDoubles = kVectorBytes / sizeof(double);
inline constexpr std::size_t kFloats = kVectorBytes / sizeof(float);

using Ints = std::int32_t __attribute__((vector_size(kVectorBytes / 2)));

// Towards zero; the values must fit.
inline Ints Truncated(Doubles v) { return __builtin_convertvector(v, Ints); }
// To 0..most; what is not a number becomes 0.
inline Doubles Clamped(Doubles v, double most)
{
  v = v > 0.0 ? v : Doubles{};
  return v < most ? v : most + Doubles{};
}

inline Doubles LoadDoubles(const double* from)
{
  Doubles v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
// value(0), value(1), ... in the lanes.
template <class Value>
Doubles InLanes(const Value& value)
{
  if constexpr (kDoubles == 4)
    return Doubles{value(0), value(1), value(2), value(3)};
  else
    return Doubles{value(0), value(1)};
}
inline void Store(double* to, Doubles v) { std::memcpy(to, &v, sizeof v); }
inline void Store(std::int32_t* to, Ints v) { std::memcpy(to, &v, sizeof v); }
inline Floats LoadFloats(const float* from)
{
  Floats v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

// Correctly rounded, as IEEE demands.
inline Doubles SquareRoots(Doubles v)
{
#if defined(__AVX__)
  return _mm256_sqrt_pd(v);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(v);
#else
  for (std::size_t k = 0; k < kDoubles; ++k) v[k] = __builtin_sqrt(v[k]);
  return v;
#endif
}

// One bit for each lane whose mask is set, lane 0 lowest.
inline unsigned Bits(FloatMask mask)
{
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  unsigned bits = 0;
  for (std::size_t k = 0; k < kFloats; ++k) bits |= (mask[k] != 0 ? 1U : 0U) << k;
  return bits;
#endif
}
inline unsigned Bits(DoubleMask mask)
{
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  unsigned bits = 0;
  for (std::size_t k = 0; k < kDoubles; ++k) bits |= (mask[k] != 0 ? 1U : 0U) << k;
  return bits;
#endif
}

// Calls `act` with the place of each bit that is set, from the lowest.
template <class Act>
void ForEachBit(unsigned bits, const Act& act)
{
  for (; bits != 0; bits &= bits - 1) act(static_cast<unsigned>(__builtin_ctz(bits)));
}

constexpr std::size_t PaddedCount(std::size_t count) { return (count + 2 * kPadding - 1) / kPadding * kPadding; }

}  // namespace swarmanoid::kinematics2d
