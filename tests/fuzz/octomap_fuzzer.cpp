// Any bytes in a file with the extension of OctoMap (.bt, .ot) are refused with a reason that names the file, or are a
// terrain that answers queries.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/space/terrain/octomap_file.h"
#include "common/space/terrain/terrain.h"
#include "tests/fuzz/fuzz_driver.h"

namespace swarmanoid
{
namespace
{

// The file is in the current folder.
std::string PathOf(const char* extension) { return "octomap_fuzzer." + std::to_string(getpid()) + extension; }

void Take(const fuzz::Input& bytes, const char* extension)
{
  const std::string path = PathOf(extension);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  try
  {
    const VoxelTerrain terrain(path);
    const Vector3 middle = (terrain.Low() + terrain.High()) / 2;
    if (!terrain.SegmentHit(terrain.Low() - Vector3::Ones(), middle) && terrain.IsSolid(middle)) std::abort();
  }
  catch (const std::runtime_error& error)
  {
    if (std::string(error.what()).find(path) == std::string::npos) std::abort();
  }
  unlink(path.c_str());
}

octomap::OcTree SmallMap()
{
  octomap::OcTree map(0.1);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y) map.updateNode(0.1 * x, 0.1 * y, 0.1 * (x % 2), (x + y) % 3 != 0);
  return map;
}

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  octomap::OcTree map = SmallMap();
  std::ostringstream binary, full;
  map.write(full);
  map.writeBinary(binary);
  std::vector<Input> inputs;
  for (const std::string& text : {binary.str(), full.str()}) inputs.emplace_back(text.begin(), text.end());
  // Every node with eight children that are described further on.
  Input deep = inputs.front();
  deep.insert(deep.end(), 200000, 0xff);
  inputs.push_back(std::move(deep));
  // The oldest files begin with bytes: the type, the size of a cell, the number of nodes.
  Input old(16, 0);
  old[0] = 3;
  old[10] = 0xf0;
  old[11] = 0x3f;
  old[12] = 1;
  old.insert(old.end(), 2, 0);
  inputs.push_back(std::move(old));
  return inputs;
}

std::vector<fuzz::Input> fuzz::Words()
{
  std::vector<Input> words;
  for (const std::string text :
       {"\nsize 99999999999\n", "\nres 1e-300\n", "\nres 1e300\n", "\ndata\n", "\nid ColorOcTree\n"})
    words.emplace_back(text.begin(), text.end());
  words.emplace_back(64, std::uint8_t{0xff});
  return words;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  const swarmanoid::fuzz::Input bytes(input, input + count);
  swarmanoid::Take(bytes, ".bt");
  swarmanoid::Take(bytes, ".ot");
  return 0;
}
