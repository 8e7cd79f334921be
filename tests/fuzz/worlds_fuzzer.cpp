// Any bytes are refused with a reason as a world of Webots or Gazebo, as a PGM or a map of ROS, and as the manifest of
// a package, or are read. A world that is read without a mistake makes an experiment whose text can be read.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>

#include "common/configuration/xml_reader.h"
#include "launcher/packages/package_manifest.h"
#include "launcher/worlds/floor_plan.h"
#include "launcher/worlds/ros_map.h"
#include "launcher/worlds/sdf_world.h"
#include "launcher/worlds/webots_world.h"
#include "test_folders.h"
#include "tests/fuzz/fuzz_driver.h"

namespace swarmanoid
{
namespace
{

template <class Read>
void Try(const Read& read)
{
  try
  {
    read();
  }
  catch (const std::runtime_error& error)
  {
    if (std::string_view(error.what()).empty()) std::abort();
  }
}

void Write(World world)
{
  if (!world.mistakes.empty()) return;
  // A mistake of syntax here is one of ours.
  try
  {
    ReadXml(ExperimentOfWorld(world, {"/", "world"}), "made.xml");
  }
  catch (const ConfigurationError&)
  {
    std::abort();
  }
}

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  std::vector<Input> inputs;
  for (const char* name : {"room.sdf", "maze.wbt", "office.pgm"})
  {
    std::ifstream file(std::string(SWARMANOID_SOURCE_FOLDER "/tests/worlds/") + name, std::ios::binary);
    inputs.push_back({std::istreambuf_iterator<char>(file), {}});
  }
  const std::string map =
      "image: office.pgm\nresolution: 0.5\norigin: [-1.5, -2, 0]\nnegate: 0\noccupied_thresh: 0.65\n";
  inputs.push_back({map.begin(), map.end()});
  const std::string manifest =
      PackageManifest{"alice", "1.0", "Alice", "MIT", "", "2.0", {{"controllers/a/a.cpp", 3, "00"}}}.Text();
  inputs.push_back({manifest.begin(), manifest.end()});
  return inputs;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  using namespace swarmanoid;
  const std::string text(input, input + count);
  // Names of meshes start in a folder without any.
  const std::string file = "/nowhere/world";
  Try([&] { Write(ReadWebotsWorld(text, file)); });
  Try([&] { Write(ReadSdfWorld(*ReadXml(text, file), file)); });
  Try([&] { PgmPicture(text); });
  Try([&] { PackageManifest::Parse(text); });
  Try([&] { ReadRosMap(text, file); });
  return 0;
}
