// image_render as an experiment file asks for it: which pictures it writes, and what its videos hold.
#include <gmock/gmock.h>

#include <filesystem>
#include <functional>

#include "common/configuration/xml_reader.h"
#include "common/plugin_descriptions/renderers.h"
#include "tests/unit/visualiser/read_png.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/unit/visualiser/video_reader.h"
#include "tests/world/fake_run.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/gl/quality.h"
#include "visualiser/scene/drawn_picture.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ImageRender : public ::testing::Test
{
protected:
  ImageRender() : world_({2, 2, 1})
  {
    RegisterBuiltinRenderers();
    world_.Add(EntityKind::kFootbot, "fb", {1, 1, 0});
  }

  std::unique_ptr<Visualiser> Make(const std::string& attributes, const std::string& children = "")
  {
    RenderConfiguration configuration;
    configuration.tag = "image_render";
    configuration.id = "images";
    configuration.tree = TConfigurationTree(
        ReadXml("<image_render " +
                    (attributes.find("size=") == std::string::npos ? std::string("size=\"96, 64\" ") : std::string()) +
                    attributes + ">" + children + "</image_render>",
                "images.xml"));
    return std::make_unique<Visualiser>(configuration, world_.Space(), assignment_, folder_.Path(), nullptr, &run_);
  }

  // Returns the tick after which the renderer wanted the end, or -1.
  int Run(const std::string& attributes, int ticks, int step = 1)
  {
    const auto visualiser = Make(attributes);
    int ended = -1;
    for (int tick = 0; tick <= ticks && ended < 0; tick += step)
    {
      world_.Space().SetTick(static_cast<std::uint64_t>(tick));
      world_.Space().SetPose(0, {{0.5 + 0.02 * tick, 1, 0}, Quaternion::Identity()});
      if (visualiser->Draw()) ended = tick;
    }
    visualiser->Finish();
    return ended;
  }

  std::vector<std::string> Files(const std::string& folder = "frames") const
  {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  std::string ErrorOf(const std::string& attributes, const std::string& children = "")
  {
    return test::MessageOf<std::runtime_error>([&] { Make(attributes, children); });
  }

  SmallWorld world_;
  Assignment assignment_;
  test::FakeMonitor run_;
  test::TemporaryFolder folder_;
};

// The rows of two pictures of the same size that differ.
std::vector<int> RowsThatDiffer(const Picture& one, const Picture& other)
{
  std::vector<int> rows;
  const auto row = static_cast<std::ptrdiff_t>(4 * one.width);
  for (int y = 0; y < one.height; ++y)
    if (!std::equal(one.At(0, y), one.At(0, y) + row, other.At(0, y))) rows.push_back(y);
  return rows;
}

TEST(SceneOptions, EachParameterSwitchesItsOwn)
{
  const std::vector<ParameterSpec> specs = QualityParameters();
  const auto switched = [&](const test::TestParameters& parameters)
  {
    const SceneOptions options = SceneOptionsOf(Parameters(test::TreeOf(parameters), specs));
    return std::vector<bool>{options.ids, options.trails, options.rays, options.collision_models};
  };
  EXPECT_THAT(switched({}), testing::Each(false));
  EXPECT_THAT(switched({{"show_ids", "true"}}), ElementsAre(true, false, false, false));
  EXPECT_THAT(switched({{"show_trails", "true"}}), ElementsAre(false, true, false, false));
  EXPECT_THAT(switched({{"show_rays", "true"}}), ElementsAre(false, false, true, false));
  EXPECT_THAT(switched({{"show_collision_models", "true"}}), ElementsAre(false, false, false, true));
}

TEST_F(ImageRender, WritesNumberedPicturesAtTheTicksAsked)
{
  Run("every=\"4\" from=\"2\" to=\"12\"", 20);
  EXPECT_THAT(Files(), ElementsAre("frame_000002.png", "frame_000006.png", "frame_000010.png"));
  const Picture picture = ReadPng(Path("frames/frame_000002.png"));
  EXPECT_EQ(picture.width, 96);
  EXPECT_EQ(picture.height, 64);
  EXPECT_NE(picture.pixels, ReadPng(Path("frames/frame_000010.png")).pixels);
}

// Straight from above, in the colours that they have: an area, a body, a line, a dot, a text.
TEST_F(ImageRender, ShowsWhatExperimentFunctionsDraw)
{
  const auto pixels_of = [&](const std::string& name, const std::function<void(Drawing&)>& draw)
  {
    Drawing drawing;
    draw(drawing);
    world_.Space().SwapDrawing(drawing);
    Run("camera=\"top\" size=\"320, 320\" file=\"" + name + ".png\"", 0);
    const Picture picture = ReadPng(Path(name + ".png"));
    int found = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
      {
        const std::uint8_t* pixel = picture.At(x, y);
        found += pixel[0] > 200 && pixel[1] < 60 && pixel[2] > 200;
      }
    return found;
  };
  const Ink ink{0xff00ff};
  const Pose at{{1.5, 1.5, 0.001}, Quaternion::Identity()};
  EXPECT_EQ(pixels_of("nothing", [](Drawing&) {}), 0);
  const int disc = pixels_of("disc", [&](Drawing& drawing) { drawing.Disc(at, 0.2, ink); });
  const int box = pixels_of("box", [&](Drawing& drawing) { drawing.Box(at, {0.4, 0.4, 0.1}, ink); });
  EXPECT_GT(disc, 1000);
  EXPECT_NEAR(disc / static_cast<double>(box), 0.785, 0.08) << "a circle within a square";
  const int thin = pixels_of("line", [&](Drawing& drawing) { drawing.Segment({0.3, 0.3, 0}, {0.3, 1.5, 0}, ink); });
  const int wide = pixels_of("wide",
                             [&](Drawing& drawing) {
                               drawing.Segment({0.3, 0.3, 0}, {0.3, 1.5, 0}, {0xff00ff, 1, 9});
                             });
  EXPECT_GT(thin, 50);
  EXPECT_GT(wide, 3 * thin);
  EXPECT_NEAR(pixels_of("dot", [&](Drawing& drawing) { drawing.Point({0.5, 0.5, 0}, {0xff00ff, 1, 20}); }), 314, 60);
  const auto write = [&](Drawing& drawing) { drawing.Text({0.3, 0.5, 0}, "MMMM", ink); };
  EXPECT_GT(pixels_of("text", write), 40);
  const auto write_beside = [&](Drawing& drawing)
  {
    drawing.Disc(at, 0.2, {0x0000ff, 0.5});
    write(drawing);
  };
  EXPECT_GT(pixels_of("both", write_beside), 40);
  // On the robot, which hides what is below it.
  EXPECT_GT(pixels_of("above",
                      [&](Drawing& drawing) {
                        drawing.InFrameOf(0), drawing.Disc({{0, 0, 0.4}, Quaternion::Identity()}, 0.05, ink);
                      }),
            30);
  EXPECT_EQ(pixels_of("below",
                      [&](Drawing& drawing) {
                        drawing.InFrameOf(0), drawing.Disc({{0, 0, 0.01}, Quaternion::Identity()}, 0.02, ink);
                      }),
            0);
}

TEST_F(ImageRender, TakesTheNextStateWhereTicksAreMissed)
{
  Run("every=\"4\" directory=\"here\" filename=\"picture\"", 21, 3);
  EXPECT_THAT(Files("here"), ElementsAre("picture_000000.png", "picture_000006.png", "picture_000009.png",
                                         "picture_000012.png", "picture_000018.png", "picture_000021.png"));
}

TEST_F(ImageRender, WritesOnePictureAndEndsWhereAsked)
{
  EXPECT_EQ(Run("at=\"3\" file=\"one.png\" stop=\"true\"", 20), 3);
  EXPECT_THAT(Files("."), ElementsAre("one.png"));
  EXPECT_EQ(Run("at=\"3\" file=\"one.png\"", 20), -1);
}

TEST_F(ImageRender, ALineBelowSaysHowTheRunGoes)
{
  Run("file=\"plain.png\"", 0);
  Run("file=\"tick.png\" show_status=\"true\"", 0);
  run_.status.phase = RunStatus::Phase::kRunning;
  run_.status.processes.push_back({"engine 'ground'", "here:1", 0, 3, ""});
  Run("file=\"late.png\" show_status=\"true\"", 0);
  const Picture plain = ReadPng(Path("plain.png"));
  const Picture tick = ReadPng(Path("tick.png"));
  ASSERT_FALSE(RowsThatDiffer(plain, tick).empty());
  EXPECT_GE(RowsThatDiffer(plain, tick).front(), 64 - 30);
  EXPECT_FALSE(RowsThatDiffer(tick, ReadPng(Path("late.png"))).empty());
}

TEST_F(ImageRender, ALineBelowShowsTheClockAndTheScale)
{
  Run("file=\"plain.png\"", 0);
  Run("file=\"clock.png\" show_clock=\"true\"", 0);
  Run("file=\"both.png\" show_clock=\"true\" show_scale=\"true\"", 0);
  const Picture clock = ReadPng(Path("clock.png"));
  ASSERT_FALSE(RowsThatDiffer(ReadPng(Path("plain.png")), clock).empty());
  EXPECT_GE(RowsThatDiffer(ReadPng(Path("plain.png")), clock).front(), 64 - 30);
  EXPECT_FALSE(RowsThatDiffer(clock, ReadPng(Path("both.png"))).empty());
  EXPECT_THROW(Run("file=\"no.png\" show_scale=\"true\" use_textures=\"false\"", 0), ConfigurationError);
}

TEST_F(ImageRender, TextsGrowWithLargePictures)
{
  const auto rows_of_the_clock = [&](const std::string& size)
  {
    Run("file=\"plain.png\" use_shadows=\"false\" antialiasing=\"0\" size=\"" + size + "\"", 0);
    Run("file=\"clock.png\" use_shadows=\"false\" antialiasing=\"0\" show_clock=\"true\" size=\"" + size + "\"", 0);
    return RowsThatDiffer(ReadPng(Path("plain.png")), ReadPng(Path("clock.png"))).size();
  };
  const std::size_t small = rows_of_the_clock("100, 1080");
  EXPECT_NEAR(static_cast<double>(rows_of_the_clock("100, 2160")), 2.0 * static_cast<double>(small), 2);
}

TEST_F(ImageRender, LabelsNameTheOwners)
{
  assignment_.owner = {-1};
  assignment_.host = {-1};
  Run("file=\"ids.png\" show_ids=\"true\"", 0);
  Run("file=\"owners.png\" show_owners=\"true\"", 0);
  assignment_.host = {1};
  Run("file=\"host.png\" show_owners=\"true\"", 0);
  const Picture ids = ReadPng(Path("ids.png"));
  EXPECT_TRUE(RowsThatDiffer(ids, ReadPng(Path("owners.png"))).empty());
  EXPECT_FALSE(RowsThatDiffer(ids, ReadPng(Path("host.png"))).empty());
}

TEST_F(ImageRender, TwoOfThemShareAProcess)
{
  const auto first = Make("file=\"first.png\" camera=\"top\"");
  const auto second = Make("file=\"second.png\" camera=\"1,-1,1/90,-30,0\"");
  first->Draw();
  second->Draw();
  const Picture before = ReadPng(Path("first.png"));
  first->Draw();
  EXPECT_EQ(ReadPng(Path("first.png")).pixels, before.pixels);
  EXPECT_NE(ReadPng(Path("second.png")).pixels, before.pixels);
}

TEST_F(ImageRender, VideosRunInSimulatedTime)
{
  if (!HasVideo()) GTEST_SKIP() << "this build has no video";
  // A tick is 0.1 s.
  Run("video=\"run.mp4\" every=\"2\" speed=\"2\"", 40);
  const VideoContents video = ReadVideo(Path("run.mp4"));
  EXPECT_EQ(video.codec, "h264");
  EXPECT_EQ(video.pictures, 21);
  EXPECT_EQ(video.width, 96);
  EXPECT_EQ(video.height, 64);
  EXPECT_NEAR(video.seconds, 2.0, 0.011);
  EXPECT_FALSE(fs::exists(folder_ / "frames"));
}

TEST_F(ImageRender, VideosHoldThePicturesThatWereDrawn)
{
  if (!HasVideo()) GTEST_SKIP() << "this build has no video";
  for (const std::string ending : {"webm", "gif"})
  {
    Run("video=\"run." + ending + "\" directory=\"" + ending + "\"", 12);
    const VideoContents video = ReadVideo(Path("run." + ending));
    EXPECT_EQ(video.pictures, 13) << ending;
    EXPECT_NEAR(video.seconds, 1.2, 0.011) << ending;
    const Picture drawn = ReadPng(Path(ending + "/frame_000012.png"));
    double difference = 0;
    for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
      if (i % 4 != 3) difference += std::abs(drawn.pixels[i] - video.last.pixels[i]);
    EXPECT_LT(difference / (3 * 96 * 64), 6) << ending;
  }
}

TEST_F(ImageRender, MistakesAreNamedWithTheirCure)
{
  EXPECT_THAT(ErrorOf("camera=\"3\""), HasSubstr("there is no camera_view_XYZ_3"));
  EXPECT_THAT(ErrorOf("camera=\"above\""), HasSubstr("it must be the number of a viewpoint, top, default"));
  EXPECT_THAT(ErrorOf("from=\"9\" to=\"3\""), HasSubstr("the later tick"));
  EXPECT_THAT(ErrorOf("", "<camera_view_XYZ_12>1,2,3</camera_view_XYZ_12>"), HasSubstr("0 to 9"));
  EXPECT_THAT(ErrorOf("", "<camera_view_HPR_1>1,2,3</camera_view_HPR_1>"), HasSubstr("add camera_view_XYZ_1"));
  if (HasVideo())
    EXPECT_THAT(ErrorOf("video=\"run.film\""), HasSubstr("must end in .mp4, .webm"));
  else
    EXPECT_THAT(ErrorOf("video=\"run.mp4\""), HasSubstr("install the packages libavcodec-dev"));
}

}  // namespace
}  // namespace swarmanoid
