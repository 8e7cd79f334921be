#include "common/space/terrain/octomap_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr const char* kBinaryStart = "# Octomap OcTree binary file";
constexpr const char* kFullStart = "# Octomap OcTree file";

struct Header
{
  std::string type;
  std::size_t nodes = 0;
  double resolution = 0;
};

// The lines from after the first one to the data. False where they are none of OctoMap's.
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
  return file && file.get() == '\n' && header.resolution > 0;
}

}  // namespace

std::unique_ptr<octomap::OcTree> ReadOctoMap(const std::string& path)
{
  const std::string extension = std::filesystem::path(path).extension().string();
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("'" + path + "' is not there");
  const bool is_binary = extension == ".bt";
  if (!is_binary && extension != ".ot") throw std::runtime_error("'" + path + "' must end in .bt or .ot");

  std::ifstream file(path, std::ios::binary);
  std::string first;
  std::getline(file, first);
  if (!first.starts_with(is_binary ? kBinaryStart : kFullStart))
  {
    // Very old .bt files have no header; OctoMap knows them.
    auto map = std::make_unique<octomap::OcTree>(0.1);
    if (is_binary && map->readBinary(path)) return map;
    throw std::runtime_error("'" + path + "' is not an OctoMap occupancy tree");
  }
  Header header;
  if (!ReadHeader(file, header) || header.type != "OcTree")
    throw std::runtime_error("'" + path + "' is not an OctoMap occupancy tree");

  auto map = std::make_unique<octomap::OcTree>(header.resolution);
  if (header.nodes == 0) return map;
  try
  {
    // OctoMap itself goes on at the end of a file that is too short.
    file.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
    if (is_binary)
      map->readBinaryData(file);
    else
      map->readData(file);
  }
  catch (const std::ios::failure&)
  {
    throw std::runtime_error("'" + path + "' is cut short");
  }
  if (map->size() != header.nodes) throw std::runtime_error("'" + path + "' is damaged");
  return map;
}

void WriteOctoMap(const std::string& path, const octomap::OcTree& map)
{
  std::ofstream file(path, std::ios::binary);
  file << fmt::format("{}\nid {}\nsize {}\nres {}\ndata\n", kBinaryStart, map.getTreeType(), map.size(),
                      map.getResolution());
  if (map.getRoot() != nullptr) map.writeBinaryNode(file, map.getRoot());
  file.flush();
  if (!file) throw std::runtime_error("cannot write '" + path + "'");
}

}  // namespace swarmanoid
