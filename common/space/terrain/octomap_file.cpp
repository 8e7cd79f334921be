#include "common/space/terrain/octomap_file.h"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/configuration/regular_file.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kBinaryStart = "# Octomap OcTree binary file";
constexpr const char* kFullStart = "# Octomap OcTree file";

constexpr const char* kColoured = "ColorOcTree";

constexpr std::uint64_t kMostTreeBytes = std::uint64_t{1} << 30U;
// A tree of this size takes some gigabytes.
constexpr std::size_t kMostNodes = std::size_t{1} << 26U;
constexpr int kDepth = 16;  // the depth of OctoMap's trees
constexpr double kFinest = 1e-6;
constexpr double kCoarsest = 1e6;

struct Header
{
  std::string type = "OcTree";
  std::size_t nodes = 0;
  double resolution = 0;
};

// Returns the lines from the second one to the data, or false if they are not those of OctoMap.
bool ReadHeader(std::istream& file, Header& header)
{
  std::string word;
  while (file >> word && word != "data")
  {
    if (word == "id") file >> header.type;
    if (word == "size") file >> header.nodes;
    if (word == "res") file >> header.resolution;
    if (word.front() == '#') std::getline(file, word);
  }
  return file && file.get() == '\n' &&
         (header.type == "OcTree" || header.type == kColoured || header.type == "OcTreeStamped");
}

// Returns the nodes of a ColorOcTree without their colours: a probability, three bytes of colour, the children.
std::string WithoutColours(std::string_view nodes)
{
  constexpr std::size_t kColour = 3, kNode = sizeof(float) + kColour + 1;
  std::string plain;
  plain.reserve(nodes.size() / kNode * (kNode - kColour));
  for (; nodes.size() >= kNode; nodes.remove_prefix(kNode))
  {
    plain += nodes.substr(0, sizeof(float));
    plain += nodes[kNode - 1];
  }
  return plain;
}

// Very old .bt files have a binary header instead.
bool ReadOldHeader(std::istream& file, Header& header)
{
  constexpr std::int32_t kOccupancyTree = 3;
  std::int32_t type = 0;
  std::uint32_t nodes = 0;
  file.read(reinterpret_cast<char*>(&type), sizeof type);
  file.read(reinterpret_cast<char*>(&header.resolution), sizeof header.resolution);
  file.read(reinterpret_cast<char*>(&nodes), sizeof nodes);
  header.nodes = nodes;
  return file && type == kOccupancyTree;
}

// The children of a node, as the data describes them.
struct Children
{
  int nodes = 0;
  int described = 0;  // children described later in the data, one after the other, each with its own children
};

// Reads two bytes with two bits for each child: unknown, a free leaf, an occupied leaf, described.
Children ChildrenInBinary(const char* node)
{
  Children children;
  for (unsigned child = 0; child < 8; ++child)
  {
    const unsigned bits = static_cast<unsigned char>(node[child / 4]) >> (2 * (child % 4)) & 3U;
    children.nodes += bits != 0;
    children.described += bits == 3;
  }
  return children;
}

// Reads a probability (float), then one bit for each child.
Children ChildrenInFull(const char* node)
{
  const int count = std::popcount(static_cast<unsigned char>(node[sizeof(float)]));
  return {count, count};
}

// OctoMap recurses as deep as the data says and allocates what it says. This check bounds both. Returns the reason why
// the data is no tree of that many nodes, or nullptr.
const char* MistakeInData(std::string_view data, bool is_binary, std::size_t nodes)
{
  const std::size_t bytes = is_binary ? 2 : sizeof(float) + 1;
  std::array<int, kDepth + 1> left{1};  // the number of described nodes that are still to come, by depth
  int depth = 0;
  std::size_t count = 1;
  std::size_t at = 0;
  while (depth >= 0)
  {
    if (left[static_cast<std::size_t>(depth)] == 0)
    {
      --depth;
      continue;
    }
    --left[static_cast<std::size_t>(depth)];
    if (data.size() - at < bytes) return "is cut short";
    const Children children = is_binary ? ChildrenInBinary(data.data() + at) : ChildrenInFull(data.data() + at);
    at += bytes;
    count += static_cast<std::size_t>(children.nodes);
    if (count > nodes || (children.nodes > 0 && depth == kDepth)) return "is damaged";
    if (children.described == 0) continue;
    ++depth;
    left[static_cast<std::size_t>(depth)] = children.described;
  }
  return count == nodes ? nullptr : "is damaged";
}

}  // namespace

std::unique_ptr<octomap::OcTree> ReadOctoMap(const std::string& path)
{
  const auto fail = [&](const std::string& why) { throw std::runtime_error(fmt::format("'{}' {}", path, why)); };
  const std::string extension = std::filesystem::path(path).extension().string();
  const bool is_binary = extension == ".bt";
  if (!is_binary && extension != ".ot") fail("must end in .bt or .ot");
  std::string bytes;
  try
  {
    bytes = ReadRegularFile(path, kMostTreeBytes);
  }
  catch (const FileError& error)
  {
    fail(fmt::format("cannot be read: {}", error.what()));
  }

  std::istringstream file(bytes);
  Header header;
  const bool has_lines = bytes.starts_with(is_binary ? kBinaryStart : kFullStart);
  if (has_lines) file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  const bool good = has_lines ? ReadHeader(file, header) : is_binary && ReadOldHeader(file, header);
  if (!good) fail("is not an OctoMap occupancy tree");
  if (!(header.resolution >= kFinest && header.resolution <= kCoarsest))
    fail(fmt::format("has cells of {} m; they must be from {} to {} m", header.resolution, kFinest, kCoarsest));
  if (header.nodes > kMostNodes)
    fail(fmt::format("has {} nodes, or says so; {} are the most that are read", header.nodes, kMostNodes));

  auto map = std::make_unique<octomap::OcTree>(header.resolution);
  if (header.nodes == 0) return map;
  std::string data = bytes.substr(static_cast<std::size_t>(file.tellg()));
  if (header.type == kColoured && !is_binary) data = WithoutColours(data);
  if (const char* mistake = MistakeInData(data, is_binary, header.nodes)) fail(mistake);
  file = std::istringstream(std::move(data));
  if (is_binary)
    map->readBinaryData(file);
  else
    map->readData(file);
  if (map->size() != header.nodes) fail("is damaged");
  return map;
}

void WriteOctoMap(const std::string& path, const octomap::OcTree& map)
{
  std::ofstream file(path, std::ios::binary);
  file << fmt::format("{}\nid {}\nsize {}\nres {}\ndata\n", kBinaryStart, map.getTreeType(), map.size(),
                      map.getResolution());
  if (map.getRoot() != nullptr) map.writeBinaryNode(file, map.getRoot());
  file.flush();
  if (!file) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
}

}  // namespace swarmanoid
