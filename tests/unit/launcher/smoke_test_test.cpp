#include "launcher/smoke_test.h"

#include <gmock/gmock.h>

#include "common/errors/exit_codes.h"
#include "simulation/register_all.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"
#include "visualiser/renderer_library.h"

namespace swarmanoid
{
namespace
{

// Returns the exit code of the test of an experiment whose second visualisation this program does not have, and what it
// prints.
std::pair<int, std::string> Tested(bool visualisations)
{
  RegisterBuiltins();
  const std::unique_ptr<Experiment> experiment =
      test::ExperimentText{.visualisations = "<text_render id='t'/>\n<text_render id='a'/>"}.Load();
  experiment->visualisations.back().tag = "absent_render";
  testing::internal::CaptureStderr();
  const int code = SmokeTest(*experiment, visualisations);
  return {code, testing::internal::GetCapturedStderr()};
}

TEST(SmokeTests, AVisualisationThatIsNotThereIsRefusedAtItsPlaceAsByARun)
{
  const auto [code, said] = Tested(true);
  EXPECT_EQ(code, kExitInvalidFile);
  EXPECT_THAT(said, testing::MatchesRegex("test.xml:[0-9]+:1: no renderer is registered as 'absent_render'; .*\n"));
}

TEST(SmokeTests, VisualisationsAreNotMadeForARunWithoutThem)
{
  EXPECT_EQ(Tested(false), std::pair(int{kExitDone}, std::string()));
}

TEST(RendererLibraries, OneThatIsNotInstalledIsNamedWithItsPackages)
{
  EXPECT_THAT(test::MessageOf<ConfigurationError>(RendererFromLibrary("absent_render", "libabsent-dev")),
              testing::MatchesRegex("absent_render is not installed, there is no .*/swarmanoid/libswarmanoid_absent_"
                                    "render.so; install the package swarmanoid, or .* libabsent-dev, and build again"));
}

}  // namespace
}  // namespace swarmanoid
