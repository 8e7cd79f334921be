// Explicit vectors for the inner loops of sensors, engines and grids: eight floats and four doubles if the processor
// has them. All operations work lane by lane, so that the number of lanes changes no result.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace swarmanoid
{

#if defined(__AVX__)
inline constexpr int kLanes = 8;
#else
inline constexpr int kLanes = 4;
#endif
inline constexpr int kDoubleLanes = kLanes / 2;
inline constexpr int kByteLanes = kLanes * 4;

typedef float FloatLanes __attribute__((vector_size(kLanes * sizeof(float))));
typedef std::int32_t IntLanes __attribute__((vector_size(kLanes * sizeof(float))));
typedef double DoubleLanes __attribute__((vector_size(kDoubleLanes * sizeof(double))));
typedef std::int64_t LongLanes __attribute__((vector_size(kDoubleLanes * sizeof(double))));
typedef std::uint8_t ByteLanes __attribute__((vector_size(kByteLanes)));
// Has as many integers as there are double lanes.
typedef std::int32_t HalfIntLanes __attribute__((vector_size(kDoubleLanes * sizeof(std::int32_t))));

// Loads lanes from any address.
template <class Lanes, class Number>
Lanes LoadAs(const Number* from)
{
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline FloatLanes LoadLanes(const float* from) { return LoadAs<FloatLanes>(from); }
inline IntLanes LoadLanes(const std::int32_t* from) { return LoadAs<IntLanes>(from); }
inline DoubleLanes LoadLanes(const double* from) { return LoadAs<DoubleLanes>(from); }
inline ByteLanes LoadLanes(const std::uint8_t* from) { return LoadAs<ByteLanes>(from); }
inline void StoreLanes(FloatLanes lanes, float* to) { std::memcpy(to, &lanes, sizeof lanes); }
inline void StoreLanes(IntLanes lanes, std::int32_t* to) { std::memcpy(to, &lanes, sizeof lanes); }
inline void StoreLanes(DoubleLanes lanes, double* to) { std::memcpy(to, &lanes, sizeof lanes); }
inline void StoreLanes(HalfIntLanes lanes, std::int32_t* to) { std::memcpy(to, &lanes, sizeof lanes); }
inline void StoreLanes(ByteLanes lanes, std::uint8_t* to) { std::memcpy(to, &lanes, sizeof lanes); }
// Stores the lowest byte of each lane.
inline void StoreLowBytes(IntLanes lanes, std::uint8_t* to)
{
#if defined(__AVX2__)
  const __m256i order = _mm256_set1_epi32(0x0c080400);
  const __m256i fours = _mm256_shuffle_epi8(reinterpret_cast<__m256i>(lanes), order);
  const __m128i bytes = _mm_unpacklo_epi32(_mm256_castsi256_si128(fours), _mm256_extracti128_si256(fours, 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), bytes);
#else
  for (int i = 0; i < kLanes; ++i) to[i] = static_cast<std::uint8_t>(lanes[i]);
#endif
}
// Returns the differences between kLanes doubles and one double, in single precision.
inline FloatLanes Differences(const double* from, double other)
{
#if defined(__AVX__)
  const __m256d origin = _mm256_set1_pd(other);
  return reinterpret_cast<FloatLanes>(_mm256_set_m128(_mm256_cvtpd_ps(_mm256_loadu_pd(from + 4) - origin),
                                                      _mm256_cvtpd_ps(_mm256_loadu_pd(from) - origin)));
#else
  FloatLanes lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<float>(from[i] - other);
  return lanes;
#endif
}
// Returns value(0), value(1) … in the lanes.
template <class Value>
DoubleLanes InLanes(const Value& value)
{
  if constexpr (kDoubleLanes == 4)
    return DoubleLanes{value(0), value(1), value(2), value(3)};
  else
    return DoubleLanes{value(0), value(1)};
}
// Returns a number from each of these indices.
inline FloatLanes Gathered(const float* from, IntLanes places)
{
#if defined(__AVX2__)
  return reinterpret_cast<FloatLanes>(_mm256_i32gather_ps(from, reinterpret_cast<__m256i>(places), sizeof(float)));
#else
  FloatLanes lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = from[places[i]];
  return lanes;
#endif
}
inline DoubleLanes Gathered(const double* from, HalfIntLanes places)
{
#if defined(__AVX2__)
  // The masked form is used, since GCC reports the start register of the unmasked one as uninitialised.
  const __m256d all = reinterpret_cast<__m256d>(LongLanes{} - 1);
  return _mm256_mask_i32gather_pd(DoubleLanes{}, from, reinterpret_cast<__m128i>(places), all, sizeof(double));
#else
  return InLanes([&](int i) { return from[places[i]]; });
#endif
}
inline IntLanes Gathered(const std::int32_t* from, IntLanes places)
{
#if defined(__AVX2__)
  return reinterpret_cast<IntLanes>(_mm256_i32gather_epi32(from, reinterpret_cast<__m256i>(places), sizeof(float)));
#else
  IntLanes lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = from[places[i]];
  return lanes;
#endif
}
// Three bytes behind each index must be readable.
inline IntLanes Gathered(const std::uint8_t* from, IntLanes places)
{
#if defined(__AVX2__)
  const auto* const start = reinterpret_cast<const int*>(from);
  return reinterpret_cast<IntLanes>(_mm256_i32gather_epi32(start, reinterpret_cast<__m256i>(places), 1)) & 255;
#else
  IntLanes lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = from[places[i]];
  return lanes;
#endif
}

// (Adding to 0 would take a second instruction, since it turns -0 into 0.)
inline FloatLanes Everywhere(float value) { return value - FloatLanes{}; }
inline DoubleLanes Everywhere(double value) { return value - DoubleLanes{}; }
inline IntLanes Everywhere(int value) { return IntLanes{} + value; }
inline ByteLanes Everywhere(std::uint8_t value) { return ByteLanes{} + value; }
// Returns b if either is not a number.
inline FloatLanes Minimum(FloatLanes a, FloatLanes b) { return a < b ? a : b; }
inline DoubleLanes Minimum(DoubleLanes a, DoubleLanes b) { return a < b ? a : b; }
inline ByteLanes Minimum(ByteLanes a, ByteLanes b) { return a < b ? a : b; }
inline FloatLanes Maximum(FloatLanes a, FloatLanes b) { return a > b ? a : b; }
inline DoubleLanes Maximum(DoubleLanes a, DoubleLanes b) { return a > b ? a : b; }
inline ByteLanes Maximum(ByteLanes a, ByteLanes b) { return a > b ? a : b; }
inline FloatLanes Magnitude(FloatLanes lanes) { return lanes < 0 ? -lanes : lanes; }
// Rounds towards zero; the values must fit.
inline IntLanes Truncated(FloatLanes lanes) { return __builtin_convertvector(lanes, IntLanes); }
inline HalfIntLanes Truncated(DoubleLanes lanes) { return __builtin_convertvector(lanes, HalfIntLanes); }
// Returns 0, 1, 2 …
inline IntLanes LaneNumbers()
{
#if defined(__AVX__)
  return IntLanes{0, 1, 2, 3, 4, 5, 6, 7};
#else
  return IntLanes{0, 1, 2, 3};
#endif
}
// Returns -1 in the first `count` lanes, 0 in the others.
inline IntLanes FirstLanes(std::size_t count) { return LaneNumbers() < static_cast<int>(count); }

// Returns the lowest of each four lanes, in all four of them.
inline FloatLanes LowestOfFour(FloatLanes lanes)
{
#if defined(__AVX__)
  lanes = Minimum(lanes, __builtin_shufflevector(lanes, lanes, 2, 3, 0, 1, 6, 7, 4, 5));
  return Minimum(lanes, __builtin_shufflevector(lanes, lanes, 1, 0, 3, 2, 5, 4, 7, 6));
#else
  lanes = Minimum(lanes, __builtin_shufflevector(lanes, lanes, 2, 3, 0, 1));
  return Minimum(lanes, __builtin_shufflevector(lanes, lanes, 1, 0, 3, 2));
#endif
}
// Returns the lowest of all lanes.
inline float Lowest(FloatLanes lanes)
{
  lanes = LowestOfFour(lanes);
  return lanes[0] < lanes[kLanes - 1] ? lanes[0] : lanes[kLanes - 1];
}
inline float Highest(FloatLanes lanes) { return -Lowest(-lanes); }

// The result is correctly rounded, as IEEE requires.
inline FloatLanes SquareRoot(FloatLanes lanes)
{
#if defined(__AVX__)
  return reinterpret_cast<FloatLanes>(_mm256_sqrt_ps(reinterpret_cast<__m256>(lanes)));
#elif defined(__SSE2__)
  return reinterpret_cast<FloatLanes>(_mm_sqrt_ps(reinterpret_cast<__m128>(lanes)));
#else
  for (int i = 0; i < kLanes; ++i) lanes[i] = __builtin_sqrtf(lanes[i]);
  return lanes;
#endif
}
inline DoubleLanes SquareRoot(DoubleLanes lanes)
{
#if defined(__AVX__)
  return _mm256_sqrt_pd(lanes);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(lanes);
#else
  for (int i = 0; i < kDoubleLanes; ++i) lanes[i] = __builtin_sqrt(lanes[i]);
  return lanes;
#endif
}

// Returns one bit for each lane that is not 0; comparisons give -1 or 0. Lane 0 is the lowest bit.
template <class Lanes>
unsigned LaneMask(Lanes lanes)
{
#if defined(__AVX__)
  if constexpr (sizeof lanes[0] == sizeof(float))
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(lanes)));
  else
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(lanes)));
#elif defined(__SSE2__)
  if constexpr (sizeof lanes[0] == sizeof(float))
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
  else
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(lanes)));
#else
  unsigned mask = 0;
  for (unsigned i = 0; i < sizeof lanes / sizeof lanes[0]; ++i) mask |= (lanes[i] != 0 ? 1U : 0U) << i;
  return mask;
#endif
}

// Does the same for lanes of bytes.
template <class Lanes>
std::uint32_t ByteMask(Lanes lanes)
{
#if defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(reinterpret_cast<__m256i>(lanes)));
#elif defined(__SSE2__) && !defined(__AVX__)
  return static_cast<std::uint32_t>(_mm_movemask_epi8(reinterpret_cast<__m128i>(lanes)));
#else
  std::uint32_t mask = 0;
  for (unsigned i = 0; i < sizeof lanes; ++i) mask |= (lanes[i] != 0 ? 1U : 0U) << i;
  return mask;
#endif
}

// Calls act(bit) for each bit that is set in a mask, from the lowest.
template <class Act>
void ForEachBit(unsigned mask, const Act& act)
{
  for (; mask != 0; mask &= mask - 1) act(static_cast<unsigned>(__builtin_ctz(mask)));
}

// Compacts lanes: stores the lanes whose bits are set in a mask, one after another. Stores write all lanes: up to
// kLanes values beyond the selected ones are overwritten.
class Selection
{
public:
  explicit Selection(unsigned mask) : mask_(mask)
  {
#if defined(__AVX2__)
    order_ = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kOrders[mask])));
#endif
  }
  unsigned Count() const { return static_cast<unsigned>(std::popcount(mask_)); }
  void Store(FloatLanes lanes, float* to) const
  {
#if defined(__AVX2__)
    StoreLanes(reinterpret_cast<FloatLanes>(_mm256_permutevar8x32_ps(reinterpret_cast<__m256>(lanes), order_)), to);
#else
    for (unsigned rest = mask_; rest != 0; rest &= rest - 1) *to++ = lanes[std::countr_zero(rest)];
#endif
  }
  void Store(IntLanes lanes, std::int32_t* to) const
  {
#if defined(__AVX2__)
    StoreLanes(reinterpret_cast<IntLanes>(_mm256_permutevar8x32_epi32(reinterpret_cast<__m256i>(lanes), order_)), to);
#else
    for (unsigned rest = mask_; rest != 0; rest &= rest - 1) *to++ = lanes[std::countr_zero(rest)];
#endif
  }

  // Stores kLanes numbers.
  void Store(const double* from, double* to) const
  {
#if defined(__AVX2__)
    const unsigned low = mask_ & 15U;
    StoreFour(from, low, to);
    StoreFour(from + 4, mask_ >> 4, to + std::popcount(low));
#else
    for (unsigned rest = mask_; rest != 0; rest &= rest - 1) *to++ = from[std::countr_zero(rest)];
#endif
  }

private:
  unsigned mask_;
#if defined(__AVX2__)
  static void StoreFour(const double* from, unsigned mask, double* to)
  {
    const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kPairOrders[mask])));
    const __m256i chosen =
        _mm256_permutevar8x32_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)), order);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), chosen);
  }
  static constexpr std::array<std::uint64_t, 256> MakeOrders()
  {
    std::array<std::uint64_t, 256> orders{};
    for (unsigned mask = 0; mask < 256; ++mask)
      for (unsigned lane = 0, place = 0; lane < 8; ++lane)
        if (mask >> lane & 1U) orders[mask] |= std::uint64_t{lane} << (8 * place++);
    return orders;
  }
  // Computes the same for masks of four, in which each bit stands for two lanes.
  static constexpr std::array<std::uint64_t, 16> MakePairOrders()
  {
    std::array<std::uint64_t, 16> orders{};
    for (unsigned mask = 0; mask < 16; ++mask)
      for (unsigned lane = 0, place = 0; lane < 4; ++lane)
        if (mask >> lane & 1U) orders[mask] |= std::uint64_t{2 * lane | (2 * lane + 1) << 8} << (16 * place++);
    return orders;
  }
  // The table has, for each mask, the numbers of its set bits, one byte each.
  static const std::array<std::uint64_t, 256> kOrders;
  static const std::array<std::uint64_t, 16> kPairOrders;
  __m256i order_;
#endif
};

#if defined(__AVX2__)
inline constexpr std::array<std::uint64_t, 256> Selection::kOrders = Selection::MakeOrders();
inline constexpr std::array<std::uint64_t, 16> Selection::kPairOrders = Selection::MakePairOrders();
#endif

}  // namespace swarmanoid
