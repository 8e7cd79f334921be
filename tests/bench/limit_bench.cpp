// How fast the diffusion of configs/diffusion_10.xml could be at most: a program for this one scene, with 24 rays a
// robot, its rule, its motion and circles that part, lists of neighbours that hold for some ticks, and nothing else: no
// noise, no other kinds, no state that can be saved, one thread. It says how far the simulator is from a program of
// one's own.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace
{

constexpr double kRadius = 0.085036758, kRange = 0.1, kTick = 0.1, kSpeed = 0.05, kWheels = 0.14;  // m, s
constexpr double kMargin = 0.08, kReach = 2 * kRadius + kRange, kCell = kReach + kMargin, kDelta = 0.1, kWall = 0.05;
constexpr int kRays = 24;
constexpr int kHolds = static_cast<int>(kMargin / 2 / (kSpeed * kTick) / 2);  // ticks; pushes are within the other half

struct Swarm
{
  explicit Swarm(int robots)
      : count(robots),
        side(std::sqrt(robots)),
        cells(static_cast<int>(side / kCell) + 3),
        x(count),
        y(count),
        c(count),
        s(count)
  {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(0.2, side - 0.2), turn(0, 2 * std::numbers::pi);
    std::vector<std::pair<double, double>> places(count);
    for (auto& [px, py] : places) px = place(random), py = place(random);
    // Neighbours stand near in memory, as with order="place".
    std::ranges::sort(places, {}, [](const auto& one) { return std::pair(std::floor(one.second / kCell), one.first); });
    for (int i = 0; i < count; ++i)
    {
      const double angle = turn(random);
      x[i] = places[i].first, y[i] = places[i].second, c[i] = std::cos(angle), s[i] = std::sin(angle);
    }
    for (int i = 0; i < kRays; ++i)
    {
      const double ray = (7.5 + 15 * i) * std::numbers::pi / 180;
      cosine[i] = std::cos(ray), sine[i] = std::sin(ray);
    }
  }

  void FindNear()
  {
    std::vector<int> first(static_cast<std::size_t>(cells) * cells + 1, 0), cell(count), sorted(count);
    for (int i = 0; i < count; ++i)
      ++first[cell[i] = (static_cast<int>(y[i] / kCell) + 1) * cells + static_cast<int>(x[i] / kCell) + 1];
    int sum = 0;
    for (int& begin : first) sum += begin, begin = sum;
    for (int i = count; i-- > 0;) sorted[--first[cell[i]]] = i;
    near.clear(), begin_of.clear();
    for (int i = 0; i < count; ++i)
    {
      begin_of.push_back(static_cast<int>(near.size()));
      for (int row = -cells; row <= cells; row += cells)
        for (int k = first[cell[i] + row - 1]; k < first[cell[i] + row + 2]; ++k)
          if (const double dx = x[sorted[k]] - x[i], dy = y[sorted[k]] - y[i];
              sorted[k] != i && dx * dx + dy * dy < kCell * kCell)
            near.push_back(sorted[k]);
    }
    begin_of.push_back(static_cast<int>(near.size()));
  }

  bool Sense(int i, double* reading) const
  {
    bool sees = false;
    const auto look = [&](auto&& distance_of)
    {
      if (!sees) std::fill_n(reading, kRays, 0.0);
      sees = true;
      for (int ray = 0; ray < kRays; ++ray)
      {
        const double d =
            distance_of(c[i] * cosine[ray] - s[i] * sine[ray], s[i] * cosine[ray] + c[i] * sine[ray]) - kRadius;
        if (d <= kRange) reading[ray] = std::max(reading[ray], d < 0.009889556 ? 1 : 0.0100527 / (d + 0.000163144));
      }
    };
    constexpr double kFar = 100;
    for (int k = begin_of[i]; k < begin_of[i + 1]; ++k)
    {
      const double dx = x[near[k]] - x[i], dy = y[near[k]] - y[i], square = dx * dx + dy * dy;
      if (square > kReach * kReach) continue;
      look(
          [&](double ux, double uy)
          {
            const double along = dx * ux + dy * uy, rest = kRadius * kRadius - (square - along * along);
            return along > 0 && rest > 0 ? along - std::sqrt(rest) : kFar;
          });
    }
    const double low = kWall, high = side - kWall, reach = kRadius + kRange;
    if (x[i] < low + reach) look([&](double ux, double) { return ux < 0 ? (low - x[i]) / ux : kFar; });
    if (x[i] > high - reach) look([&](double ux, double) { return ux > 0 ? (high - x[i]) / ux : kFar; });
    if (y[i] < low + reach) look([&](double, double uy) { return uy < 0 ? (low - y[i]) / uy : kFar; });
    if (y[i] > high - reach) look([&](double, double uy) { return uy > 0 ? (high - y[i]) / uy : kFar; });
    return sees;
  }

  void Tick()
  {
    static const double kTan = std::tan(7.5 * std::numbers::pi / 180), kTurn = kSpeed / kWheels * kTick;
    static const double kCosine = std::cos(kTurn), kSine = std::sin(kTurn), kChord = kSpeed / 2 * kTick;
    if (age++ % kHolds == 0) FindNear();
    double reading[kRays];
    for (int i = 0; i < count; ++i)
    {
      double ox = 0, oy = 0;
      if (Sense(i, reading))
        for (int ray = 0; ray < kRays; ++ray)
          ox += reading[ray] * cosine[ray] / kRays, oy += reading[ray] * sine[ray] / kRays;
      if (ox <= 0 || (ox * ox + oy * oy <= kDelta * kDelta && std::abs(oy) > ox * kTan))
      {
        x[i] += 2 * kChord * c[i], y[i] += 2 * kChord * s[i];
        continue;
      }
      const double sine_of = oy > 0 ? -kSine : kSine, before_c = c[i], before_s = s[i];
      c[i] = before_c * kCosine - before_s * sine_of, s[i] = before_s * kCosine + before_c * sine_of;
      x[i] += kChord * (before_c + c[i]) / 2, y[i] += kChord * (before_s + s[i]) / 2;
    }
    for (int i = 0; i < count; ++i)
    {
      for (int k = begin_of[i]; k < begin_of[i + 1]; ++k)
      {
        const int j = near[k];
        const double dx = x[j] - x[i], dy = y[j] - y[i], square = dx * dx + dy * dy;
        if (j < i || square >= 4 * kRadius * kRadius || square == 0) continue;
        const double apart = std::sqrt(square), push = (kRadius - apart / 2) / apart;
        x[i] -= push * dx, y[i] -= push * dy, x[j] += push * dx, y[j] += push * dy;
      }
      x[i] = std::clamp(x[i], kWall + kRadius, side - kWall - kRadius);
      y[i] = std::clamp(y[i], kWall + kRadius, side - kWall - kRadius);
    }
  }

  int count;
  double side;
  int cells;
  std::vector<double> x, y, c, s;
  std::vector<int> near, begin_of;
  double cosine[kRays], sine[kRays];
  long age = 0;
};

void BM_Limit(benchmark::State& state)
{
  Swarm swarm(static_cast<int>(state.range(0)));
  for (auto _ : state) swarm.Tick();
  state.counters["ticks/s"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(BM_Limit)->Arg(10)->Arg(1000)->Arg(10000)->Arg(1000000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
