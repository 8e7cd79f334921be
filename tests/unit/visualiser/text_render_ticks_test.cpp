// Tests the ticks of the tables of text_render, and their content.
#include <gmock/gmock.h>

#include <fstream>

#include "common/configuration/xml_reader.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

using ::testing::ElementsAre;

class TextRenderTicks : public ::testing::Test
{
protected:
  TextRenderTicks() : world_({4, 4, 2})
  {
    RegisterBuiltinRenderers();
    world_.Add(EntityKind::kFootbot, "fb", {1, 2, 0.5}, 90);
    world_.GetExperiment().max_clock = 10;
  }

  // The lines of its file after having seen these ticks.
  std::vector<std::string> Written(const std::string& attributes, const std::vector<std::uint64_t>& ticks)
  {
    RenderConfiguration configuration;
    configuration.tag = "text_render";
    configuration.id = "text";
    configuration.tree =
        TConfigurationTree(ReadXml("<text_render file=\"table.txt\" " + attributes + "/>", "text.xml"));
    Visualiser visualiser(configuration, world_.Space(), assignment_, folder_.Path(), nullptr, nullptr);
    for (const std::uint64_t tick : ticks)
    {
      world_.Space().SetTick(tick);
      visualiser.Draw();
    }
    visualiser.Finish();
    std::ifstream file(folder_ / "table.txt");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  SmallWorld world_;
  Assignment assignment_;
  test::TemporaryFolder folder_;
};

TEST_F(TextRenderTicks, WritesEveryNthTickAndTheLastOne)
{
  const std::string clock = "format=\"csv\" columns=\"clock\" ";
  EXPECT_THAT(Written(clock + "every=\"4\"", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}),
              ElementsAre("clock", "0", "4", "8", "10"));
  EXPECT_THAT(Written(clock + "every=\"5\"", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), ElementsAre("clock", "0", "5", "10"));
  // A run that is stopped, or ends by itself, has a last tick too.
  EXPECT_THAT(Written(clock + "every=\"4\"", {0, 1, 2, 3, 4, 5, 6}), ElementsAre("clock", "0", "4", "6"));
  // One that is attached misses ticks: a table is due at the first one of each period.
  EXPECT_THAT(Written(clock + "every=\"4\"", {1, 2, 5, 7, 8, 10}), ElementsAre("clock", "5", "8", "10"));
}

TEST_F(TextRenderTicks, WritesPlacesAndAnglesInDegreesInTheFormatThatIsAskedFor)
{
  EXPECT_THAT(Written("", {0}), ElementsAre("#\tclock\tEntity type\tEntity id\tX\tY\tZ\tAlpha\tBeta\tGamma",
                                            "0\t\tFootbot\tfb\t1\t2\t0.5\t0\t0\t90"));
  EXPECT_THAT(Written("format=\"json\" columns=\"Entity id, X, Gamma\"", {0}),
              ElementsAre("{\"Entity id\":\"fb\",\"X\":1,\"Gamma\":90}"));
}

}  // namespace
}  // namespace swarmanoid
