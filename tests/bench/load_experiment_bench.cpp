// Reading experiment files: robots listed one by one, and placed by <distribute>. One footbot per square metre.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>

#include "common/experiment/load_experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

void RegisterEngine()
{
  if (PluginCatalogue::Instance().Find(PluginKind::kEngine, "bench_engine") != nullptr) return;
  PluginDescription engine;
  engine.label = "bench_engine";
  engine.entity_tags = {"footbot"};
  PluginCatalogue::Instance().Add(PluginKind::kEngine, engine);
}

std::string File(const std::string& robots, int side)
{
  return fmt::format(
      "<ahss-config>\n<arena size='{0},{0},3' optimization='2D'>\n{1}</arena>\n<engines><bench_engine "
      "id='ground'/></engines>\n"
      "<arena_physics><engine id='ground'><all/></engine></arena_physics>\n</ahss-config>\n",
      side, robots);
}

void Load(benchmark::State& state, const std::string& text)
{
  RegisterEngine();
  for (auto _ : state)
  {
    const LoadedExperiment loaded = LoadExperimentText(text, "bench.xml", "/", {});
    if (!loaded.experiment) return state.SkipWithError(loaded.errors.front().Text().c_str());
    benchmark::DoNotOptimize(loaded.experiment->entities.data());
  }
}

void Listed(benchmark::State& state)
{
  const int side = static_cast<int>(std::sqrt(static_cast<double>(state.range(0))));
  std::string robots;
  for (int i = 0; i < side * side; ++i)
  {
    robots += fmt::format(
        "  <footbot id=\"fb_{}\">\n    <position>{}.5, {}.5, 0</position>\n    <orientation>0, 0, {}</orientation>\n  "
        "</footbot>\n",
        i, i % side, i / side, i % 360);
  }
  Load(state, File(robots, side));
}

void Distributed(benchmark::State& state)
{
  const int side = static_cast<int>(std::sqrt(static_cast<double>(state.range(0))));
  Load(state, File(fmt::format("<distribute quantity='{}'><footbot id='fb'/></distribute>", state.range(0)), side));
}

BENCHMARK(Listed)->Arg(100)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(Distributed)->Arg(100)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
