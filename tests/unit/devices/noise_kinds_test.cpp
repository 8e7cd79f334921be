// The kinds of noise: their moments in closed form, as docs/devices.md states them, and what ties them together.
#include "controller_host/devices/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/plugins/parameter_checks.h"
#include "controller_host/devices/device_streams.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

double Density(double x) { return std::exp(-x * x / 2) / std::sqrt(2 * kPi); }
double Tail(double x) { return 0.5 * std::erfc(x / std::sqrt(2)); }

// Variances over that of the uncut distribution; b is range over deviation.
double CutVariance(double b) { return 1 - 2 * Tail(b) - 2 * b * Density(b) + 2 * b * b * Tail(b); }
double TruncatedVariance(double b) { return 1 - 2 * b * Density(b) / (1 - 2 * Tail(b)); }

NoiseModel Made(const char* kind, double mean, double deviation, double range)
{
  return NoiseFrom(Parameters(TreeOf({{"noise_kind", kind},
                                      {"noise_mean", std::to_string(mean)},
                                      {"noise_deviation", std::to_string(deviation)},
                                      {"noise_range", std::to_string(range)}}),
                              NoiseParameters("x", "m")));
}

struct Sampled
{
  double mean = 0, deviation = 0, share_on_border = 0;
};

Sampled Sample(const NoiseModel& noise)
{
  constexpr int kDraws = 200000;
  RandomStream random(1, 2, 3, 4);
  double sum = 0, squares = 0;
  int on_border = 0;
  for (int i = 0; i < kDraws; ++i)
  {
    const double value = noise.Sample(random);
    EXPECT_LE(std::abs(value - noise.mean), noise.range + 1e-12);
    sum += value;
    squares += (value - noise.mean) * (value - noise.mean);
    on_border += std::abs(value - noise.mean) > noise.range - 1e-12;
  }
  return {sum / kDraws, std::sqrt(squares / kDraws), static_cast<double>(on_border) / kDraws};
}

TEST(NoiseKinds, CutAndTruncatedHaveTheDeviationsOfTheirClosedForms)
{
  constexpr double kMean = 0.5, kDeviation = 0.2;
  for (const double b : {0.5, 1.0, 2.0, 3.0})
  {
    SCOPED_TRACE(b);
    const Sampled cut = Sample(Made("gaussian", kMean, kDeviation, b * kDeviation));
    EXPECT_NEAR(cut.mean, kMean, 2e-3);
    EXPECT_NEAR(cut.deviation / kDeviation, std::sqrt(CutVariance(b)), 5e-3);
    EXPECT_NEAR(cut.share_on_border, 2 * Tail(b), 5e-3);
    const Sampled truncated = Sample(Made("truncated_gaussian", kMean, kDeviation, b * kDeviation));
    EXPECT_NEAR(truncated.mean, kMean, 2e-3);
    EXPECT_NEAR(truncated.deviation / kDeviation, std::sqrt(TruncatedVariance(b)), 5e-3);
    EXPECT_LT(truncated.share_on_border, 1e-4);
  }
}

// The figures of docs/devices.md.
TEST(NoiseKinds, TheTableOfTheDocumentationIsTheClosedForm)
{
  const struct
  {
    double b, on_border, cut, truncated;
  } rows[] = {
      {0.5, 0.617, 0.430, 0.284}, {1, 0.317, 0.718, 0.540}, {2, 0.0455, 0.959, 0.880}, {3, 0.0027, 0.9975, 0.987}};
  for (const auto& row : rows)
  {
    EXPECT_NEAR(2 * Tail(row.b), row.on_border, 5e-4);
    EXPECT_NEAR(std::sqrt(CutVariance(row.b)), row.cut, 5e-4);
    EXPECT_NEAR(std::sqrt(TruncatedVariance(row.b)), row.truncated, 5e-4);
  }
}

// Another size or kind of noise is the same error, larger or smaller: what follows it in the stream is the same too.
TEST(NoiseKinds, AllTakeOneNumberAndGrowWithIt)
{
  const NoiseModel kinds[] = {Made("uniform", 0, 0, 0.3), Made("gaussian", 0, 0.1, 0), Made("gaussian", 0, 0.2, 0.25),
                              Made("truncated_gaussian", 0, 0.2, 0.25)};
  for (std::uint64_t tick = 0; tick < 200; ++tick)
  {
    RandomStream reference(1, 2, 3, tick);
    const double centred = reference.Centred();
    const std::uint32_t next = reference.Bits();
    for (const NoiseModel& noise : kinds)
    {
      RandomStream random(1, 2, 3, tick);
      EXPECT_GT(noise.Sample(random) * centred, 0);
      EXPECT_EQ(random.Bits(), next);
    }
  }
}

TEST(NoiseKinds, TruncatedWithoutItsNumbersIsRefused)
{
  PluginDescription device;
  device.label = "noise_kinds_test_device";
  device.implementation = "any";
  device.parameters = NoiseParameters("x", "m", "range_");
  CheckNoiseOf(PluginKind::kSensor, device);
  const auto mistakes = [&](const TestParameters& values)
  {
    std::string all;
    for (const ConfigurationError& mistake : ParameterChecks::Instance().Mistakes(
             PluginKind::kSensor, device, Parameters(TreeOf(values), device.parameters)))
      all += std::string(mistake.what()) + "\n";
    return all;
  };
  const std::pair<std::string, std::string> kind{"range_noise_kind", "truncated_gaussian"};
  EXPECT_EQ(mistakes({kind, {"range_noise_deviation", "1"}, {"range_noise_range", "2"}}), "");
  EXPECT_EQ(mistakes({kind, {"range_noise_deviation", "0"}, {"range_noise_range", "2"}}), "") << "one end of a series";
  EXPECT_NE(mistakes({kind, {"range_noise_deviation", "1"}}).find("give 'range_noise_range' too"), std::string::npos);
  EXPECT_NE(mistakes({kind, {"range_noise_range", "1"}}).find("give 'range_noise_deviation' too"), std::string::npos);
}

// Any number of them, for robots and for others that they are about.
TEST(NoiseKinds, ManySamplesAreThoseOfOneByOne)
{
  TestWorld world;
  for (int n = 0; n < 3; ++n) world.AddFootbot(n, n);
  world.Space().SetTick(0x123456789);
  DeviceSetup setup{Parameters(TreeOf({}), {}), world.Space(), {0, 1, 2}, SensorStream("x")};
  const DeviceStreams streams(setup);
  for (const NoiseModel& noise : {Made("uniform", 0.1, 0, 0.3), Made("gaussian", 0.1, 0.2, 0),
                                  Made("gaussian", 0.1, 0.2, 0.3), Made("truncated_gaussian", 0.1, 0.2, 0.3)})
    for (std::size_t count = 0; count < 40; ++count)
    {
      const std::vector<std::uint32_t> some{2, 0, 1};
      std::vector<double> of_some(some.size() * count);
      streams.Sample(noise, some, of_some);
      auto one = of_some.begin();
      for (const std::uint32_t k : some)
      {
        RandomStream random = streams.Of(k);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(*one++, noise.Sample(random));
      }

      for (std::size_t k = 0; k < 3; ++k)
      {
        std::vector<double> samples(count);
        streams.Sample(noise, k, samples);
        RandomStream random = streams.Of(k);
        for (const double sample : samples) ASSERT_EQ(sample, noise.Sample(random));

        std::vector<std::uint64_t> others;
        for (std::size_t i = 0; i < count; ++i) others.push_back(StreamPart(k, i));
        streams.Sample(noise, k, others, samples);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(samples[i], noise.Sample(streams.Of(k, others[i])));
      }
    }
}

}  // namespace
}  // namespace swarmanoid
