// The file of a checkpoint: whatever happens to it on the way is noticed.
#include "common/checkpoint/checkpoint.h"

#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "common/checkpoint/checkpoint_format.h"
#include "common/checkpoint/host_state.h"
#include "common/experiment/urdf_kind.h"
#include "common/messages/assignment.h"
#include "common/plugins/elf_file.h"
#include "common/plugins/plugin_library.h"
#include "common/serialisation/save_check.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;

Experiment SmallExperiment()
{
  Experiment experiment;
  experiment.effective_xml = "<ahss-config><framework><maxclock>10</maxclock></framework></ahss-config>";
  experiment.engines.resize(1);
  return experiment;
}

Checkpoint SmallCheckpoint()
{
  Checkpoint checkpoint;
  checkpoint.origin = OriginOf(SmallExperiment());
  checkpoint.snapshot.tick = 200;
  checkpoint.snapshot.poses = {1, 2, 0, 0, 0, 0, 1};
  checkpoint.snapshot.attributes = {0.5};
  checkpoint.parts = {{kServerPart, {'a', 'b'}}, {"engine 'ground'", {}}, {"controller host 0", {'c'}}};
  return checkpoint;
}

class CheckpointFile : public testing::Test
{
protected:
  void Write(const std::vector<char>& bytes) const
  {
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  // Why a file is refused; empty if it is taken.
  std::string Refusal(const RestoreOptions& options = {}) const
  {
    return test::MessageOf<std::runtime_error>([&] { ReadCheckpoint(path_, SmallExperiment(), options); });
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_ / "checkpoint";
};

TEST_F(CheckpointFile, ComesBackAsItWas)
{
  WriteCheckpoint(path_, SmallCheckpoint());
  const Checkpoint read = ReadCheckpoint(path_, SmallExperiment(), {});
  EXPECT_EQ(EncodeCheckpoint(read), EncodeCheckpoint(SmallCheckpoint()));
  EXPECT_EQ(read.snapshot.poses, SmallCheckpoint().snapshot.poses);
  EXPECT_EQ(read.parts[2].name, "controller host 0");
}

TEST_F(CheckpointFile, EachChangedBitIsRefused)
{
  std::vector<char> bytes = EncodeCheckpoint(SmallCheckpoint());
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const int bit : {0, 3, 7})
    {
      bytes[at] ^= static_cast<char>(1 << bit);
      EXPECT_THROW(DecodeCheckpoint(bytes), std::runtime_error) << "bit " << bit << " of byte " << at;
      bytes[at] ^= static_cast<char>(1 << bit);
    }
  EXPECT_NO_THROW(DecodeCheckpoint(bytes));
}

TEST_F(CheckpointFile, EachLengthButItsOwnIsRefused)
{
  const std::vector<char> bytes = EncodeCheckpoint(SmallCheckpoint());
  for (std::size_t size = 0; size < bytes.size(); ++size)
  {
    Write({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_THAT(Refusal(), testing::StartsWith("checkpoint '" + path_ + "': it is ")) << size;
  }
  std::vector<char> longer = bytes;
  longer.push_back('x');
  Write(longer);
  EXPECT_THAT(Refusal(), HasSubstr("it should have " + std::to_string(bytes.size()) + " bytes and has " +
                                   std::to_string(bytes.size() + 1)));
}

TEST_F(CheckpointFile, LengthsThatAreSealedAndWrongAreRefused)
{
  const std::vector<char> good = EncodeCheckpoint(SmallCheckpoint());
  for (std::size_t at = kCheckpointHeaderBytes; at + 8 < good.size(); ++at)
  {
    std::vector<char> bytes = good;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), 8, '\xff');
    SealCheckpoint(bytes);
    try
    {
      DecodeCheckpoint(bytes);  // a number or text was changed
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_THAT(error.what(), testing::AnyOf(HasSubstr("too early"), HasSubstr("longer")));
    }
  }
}

TEST_F(CheckpointFile, OfAnotherFormatNamesBothVersions)
{
  std::vector<char> bytes = EncodeCheckpoint(SmallCheckpoint());
  bytes[kCheckpointMagic.size()] = '1';
  Write(bytes);
  EXPECT_THAT(Refusal(), HasSubstr("its format has the version '1', this program reads '" +
                                   std::string(1, kCheckpointVersion) + "'; go on with the Swarmanoid that took it"));
}

TEST_F(CheckpointFile, OfAnotherBuildIsRefusedUnlessAskedFor)
{
  Checkpoint checkpoint = SmallCheckpoint();
  checkpoint.origin.libraries.front().build = "another";
  WriteCheckpoint(path_, checkpoint);
  EXPECT_THAT(Refusal(), HasSubstr("it was taken with another build of Swarmanoid; go on with that one, start again "
                                   "with this one, or let --any-build take it"));
  EXPECT_EQ(Refusal({1, true}), "");
}

TEST_F(CheckpointFile, IsRestoredIntoALongerRunAndIntoNoOtherOne)
{
  WriteCheckpoint(path_, SmallCheckpoint());
  Experiment longer = SmallExperiment();
  longer.effective_xml = "<ahss-config><framework><maxclock>2000</maxclock></framework></ahss-config>";
  EXPECT_NO_THROW(ReadCheckpoint(path_, longer, {}));
  Experiment other = SmallExperiment();
  other.effective_xml = "<ahss-config><framework><maxclock>10</maxclock></framework><arena/></ahss-config>";
  EXPECT_THAT([&] { ReadCheckpoint(path_, other, {}); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("it is of another experiment")));
}

TEST(Fingerprints, DependNeitherOnTheLengthNorOnTheFolderOfTheFilesNorOnWhatIsShown)
{
  const auto of = [](const char* framework, const char* visualisations = "")
  {
    Experiment experiment;
    experiment.effective_xml = fmt::format("<ahss-config>\n  <framework>{}</framework>{}\n  <arena/>\n</ahss-config>",
                                           framework, visualisations);
    return FingerprintOf(experiment);
  };
  EXPECT_EQ(of("", "\n  <visualisations>\n    <text_render id=\"text\"/>\n  </visualisations>"), of(""));
  EXPECT_EQ(of("", "\n  <visualisations/>"), of(""));
  EXPECT_NE(of("", "\n  <loop_functions/>"), of(""));
  EXPECT_EQ(of("<maxclock>10</maxclock><folder>/here</folder>"), of("<maxclock>20</maxclock><folder>there</folder>"));
  EXPECT_NE(of("<seed>1</seed><folder>/here</folder>"), of("<seed>2</seed><folder>/here</folder>"));
}

// Makes an experiment of `robots` robots.
Experiment ExperimentOf(std::size_t robots)
{
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < robots; ++k) ids.push_back("fb_" + std::to_string(k));
  Experiment experiment = test::RobotsOf("", ids);
  experiment.effective_xml = SmallExperiment().effective_xml;
  return experiment;
}

SavedPart HostPart(std::size_t host, const HostState& state)
{
  ByteWriter bytes;
  WriteFields(bytes, state);
  return {HostName(host), bytes.Bytes()};
}

HostState StateOf(const Checkpoint& checkpoint, std::size_t host)
{
  HostState state;
  checkpoint.LoadPart(HostName(host), [&](ByteReader& bytes) { state = ReadFields<HostState>(bytes); });
  return state;
}

// The last one leftmost.
std::vector<double> InARow(std::size_t robots)
{
  std::vector<double> poses(7 * robots);
  for (std::size_t k = 0; k < robots; ++k) poses[k] = static_cast<double>(robots - k);
  return poses;
}

TEST_F(CheckpointFile, OfMoreOrFewerControllerHostsIsSharedOut)
{
  const Experiment experiment = ExperimentOf(5);
  Checkpoint checkpoint = SmallCheckpoint();
  checkpoint.origin = OriginOf(experiment);
  checkpoint.parts[2] = HostPart(0, {{{{1, 2}, "radio"}, {{3, 2}, "lamp"}}, {{0, "a"}, {1, "b"}}});
  checkpoint.parts.push_back(HostPart(1, {{{{1, 2}, "radio"}, {{3, 2}, "lamp"}}, {{2, "c"}, {3, "d"}, {4, "e"}}}));
  checkpoint.snapshot.poses = InARow(5);
  WriteCheckpoint(path_, checkpoint);
  // The number of hosts is the same, but their robots are near each other now.
  const Checkpoint two = ReadCheckpoint(path_, experiment, {2, false});
  EXPECT_EQ(two.parts.size(), 4U);
  EXPECT_EQ(StateOf(two, 0).robots, (std::map<std::uint32_t, std::string>{{3, "d"}, {4, "e"}}));
  EXPECT_EQ(StateOf(two, 1).robots, (std::map<std::uint32_t, std::string>{{0, "a"}, {1, "b"}, {2, "c"}}));

  const Checkpoint one = ReadCheckpoint(path_, experiment, {1, false});
  EXPECT_EQ(one.parts.size(), 3U);
  EXPECT_EQ(StateOf(one, 0).robots.size(), 5U);
  EXPECT_EQ(StateOf(one, 0).robots.at(3), "d");

  const Checkpoint three = ReadCheckpoint(path_, experiment, {3, false});
  EXPECT_EQ(three.parts.size(), 5U);
  std::map<std::uint32_t, std::string> all;
  for (std::size_t host = 0; host < 3; ++host)
  {
    const HostState state = StateOf(three, host);
    EXPECT_EQ(state.sensors, (decltype(state.sensors){{{1, 2}, "radio"}, {{3, 2}, "lamp"}}));
    EXPECT_FALSE(state.robots.empty());
    all.insert(state.robots.begin(), state.robots.end());
  }
  EXPECT_EQ(all, (std::map<std::uint32_t, std::string>{{0, "a"}, {1, "b"}, {2, "c"}, {3, "d"}, {4, "e"}}));
}

TEST_F(CheckpointFile, IsRefusedByOtherControllerHostsIfARobotIsLacking)
{
  const Experiment experiment = ExperimentOf(2);
  Checkpoint checkpoint = SmallCheckpoint();
  checkpoint.origin = OriginOf(experiment);
  checkpoint.parts[2] = HostPart(0, {{}, {{0, "a"}}});
  checkpoint.snapshot.poses = InARow(2);
  WriteCheckpoint(path_, checkpoint);
  EXPECT_THAT(
      [&] {
        ReadCheckpoint(path_, experiment, {2, false});
      },
      testing::ThrowsMessage<std::runtime_error>(HasSubstr("the state of robot 'fb_1' is missing")));
}

TEST_F(CheckpointFile, PipesDevicesAndFoldersAreRefusedAtOnce)
{
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THAT(Refusal(), HasSubstr("it is a pipe, not a file"));
  path_ = "/dev/zero";
  EXPECT_THAT(Refusal(), HasSubstr("it is a device, not a file"));
  path_ = folder_.Path();
  EXPECT_THAT(Refusal(), HasSubstr("it is a folder, not a file"));
  path_ = folder_ / "absent";
  EXPECT_THAT(Refusal(), HasSubstr("there is no such file"));
}

TEST(LibraryBuilds, KnowSwarmanoidItselfAndNameWhatDiffers)
{
  const std::vector<LibraryBuild> here = LibraryBuildsOf(SmallExperiment());
  ASSERT_EQ(here.size(), 1U);
  EXPECT_EQ(here[0].name, kSwarmanoidBuild);
  EXPECT_EQ(DifferenceOfBuilds({{"libwave.so", "1"}}, {{"libwave.so", "1"}}), "");
  EXPECT_EQ(DifferenceOfBuilds({{"libwave.so", "1"}}, {{"libwave.so", "2"}}),
            "another build of the library 'libwave.so'");
  EXPECT_EQ(DifferenceOfBuilds({{"terrain/hills.png", "1"}}, {{"terrain/hills.png", "2"}}),
            "another content of the file 'terrain/hills.png'");
  EXPECT_EQ(DifferenceOfBuilds({{"libwave.so", ""}}, {{"libwave.so", "2"}}), "") << "it was elsewhere";
}

TEST(LibraryBuilds, HaveTheFileOfARobotAndTheMeshesThatCollide)
{
  const test::TemporaryFolder folder;
  folder.Write("wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  std::string links =
      "<link name='base'><inertial><mass value='1'/></inertial><collision><geometry><mesh filename='wedge.obj'/>"
      "</geometry></collision></link>";
  for (const std::string side : {"0.1", "-0.1"})
    links += "<link name='wheel" + side +
             "'><collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.05' length='0.02'/>"
             "</geometry></collision></link><joint name='joint" +
             side + "' type='continuous'><parent link='base'/><child link='wheel" + side + "'/><origin xyz='0 " + side +
             " 0'/><axis xyz='0 1 0'/></joint>";
  const std::string file = folder.Write("cart.urdf", "<robot name='cart'>" + links + "</robot>");
  for (const Diagnostic& mistake : RegisterUrdfKind("cart_of_checkpoint", file)) FAIL() << mistake.Text();
  Experiment experiment = SmallExperiment();
  experiment.folder = folder.Path();
  experiment.entity_kinds = {{"cart_of_checkpoint", ""}};
  const auto builds = [&]
  {
    std::map<std::string, std::string> by_name;
    for (const LibraryBuild& build : LibraryBuildsOf(experiment)) by_name[build.name] = build.build;
    return by_name;
  };
  const auto before = builds();
  ASSERT_EQ(before.size(), 3U);
  folder.Write("wedge.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const auto after = builds();
  EXPECT_EQ(after.at("cart.urdf"), before.at("cart.urdf"));
  EXPECT_NE(after.at("wedge.obj"), before.at("wedge.obj"));
}

TEST(LibraryBuilds, SwarmanoidIsAllOfItsLibrariesThatTheStateDependsOn)
{
  const std::set<std::string> others{"bus",          "run",           "simulator",   "simulation", "space_server_node",
                                     "render",       "scene",         "interaction", "real_robot", "web_render",
                                     "image_render", "opengl_render", "ogre_render", "version",    "studies",
                                     "argos3_files", "launcher_bus",  "commands"};
  const std::string build = LibraryBuildsOf(SmallExperiment()).at(0).build;
  EXPECT_THAT(build, testing::Not(HasSubstr(".."))) << "a library of the list is not there";
  std::size_t looked_at = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(OwnLibraryFolder()))
  {
    const std::string name = entry.path().stem().string();
    const std::string prefix = "libswarmanoid_";
    if (entry.path().extension() != ".so" || !name.starts_with(prefix)) continue;
    if (others.contains(name.substr(prefix.size()))) continue;
    EXPECT_THAT(build, HasSubstr(BuildOfLibrary(entry.path()).substr(0, 16))) << name;
    ++looked_at;
  }
  EXPECT_GT(looked_at, 5U);
}

TEST(TrySaving, TellsBeforeTheRunThatARoleCannotBeSaved)
{
  struct Unsavable
  {
    void SaveState(ByteWriter&) const { throw std::runtime_error("its controller cannot be saved"); }
  };
  EXPECT_EQ(test::MessageOf<std::runtime_error>([] { TrySaving(Unsavable()); }), "its controller cannot be saved");
}

}  // namespace
}  // namespace swarmanoid
