// Pictures of many footbots without a window: 1024 x 768, the whole arena in view, one footbot per m2.
#include <benchmark/benchmark.h>

#include "tests/unit/visualiser/small_world.h"
#include "visualiser/gl/gl_scene.h"
#include "visualiser/image/offscreen_context.h"
#include "visualiser/scene/viewpoints.h"

namespace swarmanoid
{
namespace
{

constexpr int kWidth = 1024;
constexpr int kHeight = 768;

// Robots; 1 with shadows; samples a pixel.
void BM_Picture(benchmark::State& state)
{
  const auto robots = static_cast<int>(state.range(0));
  const int side = static_cast<int>(std::ceil(std::sqrt(robots)));
  SmallWorld world(Vector3(side, side, 1));
  for (int i = 0; i < robots; ++i)
    world.Add(EntityKind::kFootbot, "fb_" + std::to_string(i), {0.5 + i % side, 0.5 + i / side, 0}, 37 * i);
  for (int i = 0; i < robots; ++i) world.SetLeds("fb_" + std::to_string(i), 12, i % 3 == 0 ? 0xff0000 : 0);

  static OffscreenContext context;
  Scene scene(world.Space());
  GlScene renderer;
  const PictureBuffer buffer(kWidth, kHeight);
  const Camera camera = DefaultView(world.GetExperiment(), static_cast<double>(kWidth) / kHeight);
  DrawOptions options;
  options.shadows = state.range(1) != 0;
  options.samples = static_cast<int>(state.range(2));
  const Pose pose = world["fb_0"].GetPose();
  for (auto _ : state)
  {
    world.Space().SetPose(0, pose);  // All poses count as changed.
    scene.Update({});
    renderer.Draw(scene, camera, buffer.Framebuffer(), kWidth, kHeight, options);
    benchmark::DoNotOptimize(buffer.Read());
  }
  state.counters["pictures/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["triangles"] = static_cast<double>(renderer.Statistics().triangles);
  state.SetLabel(GlScene::ContextDescription());
}
BENCHMARK(BM_Picture)
    ->ArgNames({"robots", "shadows", "samples"})
    ->ArgsProduct({{100, 1000, 10000}, {0, 1}, {0, 4}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swarmanoid

BENCHMARK_MAIN();
