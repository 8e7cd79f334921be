#include "common/mesh/gltf_depth.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/configuration/regular_file.h"

namespace swarmanoid
{
namespace
{

using GltfJson = nlohmann::json;

constexpr int kMostJsonLevels = 32;
constexpr int kMostNodeLevels = 200;
// A .glb file starts with "glTF", version and length. Its first chunk starts with length and "JSON".
constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeader = 20;

std::uint32_t WordAt(std::string_view bytes, std::size_t place)
{
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + place, sizeof(word));
  return word;
}

// Returns the JSON of a file.
std::string_view JsonOf(std::string_view bytes)
{
  if (!bytes.starts_with(kGlbMagic)) return bytes;
  if (bytes.size() < kGlbHeader) throw FileError("it ends in its header");
  const std::size_t length = WordAt(bytes, 12);
  if (length > bytes.size() - kGlbHeader) throw FileError("it ends before its JSON does: it is cut off");
  return bytes.substr(kGlbHeader, length);
}

// Visits the nodes level by level from the roots. Cycles have no root, and Assimp refuses them.
void CheckNodes(const GltfJson& nodes)
{
  const auto children_of = [&](std::size_t node)
  {
    std::vector<std::size_t> children;
    if (!nodes[node].is_object() || !nodes[node].contains("children")) return children;
    for (const GltfJson& child : nodes[node]["children"])
      if (child.is_number_unsigned() && child.get<std::size_t>() < nodes.size())
        children.push_back(child.get<std::size_t>());
    return children;
  };
  std::vector<int> parents(nodes.size());
  for (std::size_t node = 0; node < nodes.size(); ++node)
    for (const std::size_t child : children_of(node))
      if (++parents[child] > 1) throw FileError(fmt::format("its node {} hangs on two others", child));
  std::vector<std::size_t> level;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (parents[node] == 0) level.push_back(node);
  for (int levels = 1; !level.empty(); ++levels)
  {
    if (levels > kMostNodeLevels)
      throw FileError(fmt::format("more than {} nodes hang on each other", kMostNodeLevels));
    std::vector<std::size_t> below;
    for (const std::size_t node : level)
      for (const std::size_t child : children_of(node)) below.push_back(child);
    level.swap(below);
  }
}

}  // namespace

void CheckGltf(std::string_view bytes)
{
  const auto check_depth = [](int depth, GltfJson::parse_event_t, GltfJson&)
  {
    if (depth > kMostJsonLevels) throw FileError(fmt::format("its JSON has more than {} levels", kMostJsonLevels));
    return true;
  };
  GltfJson file;
  try
  {
    file = GltfJson::parse(JsonOf(bytes), check_depth);
  }
  catch (const GltfJson::exception& error)
  {
    throw FileError(fmt::format("it is no glTF file: {}", error.what()));
  }
  using Pointer = GltfJson::json_pointer;
  const GltfJson version = file.is_object() ? file.value(Pointer("/asset/version"), GltfJson()) : GltfJson();
  if (!version.is_string() || !version.get<std::string>().starts_with("2"))
    throw FileError("it is not of version 2 of glTF; export it again");
  if (file.contains("nodes") && file["nodes"].is_array()) CheckNodes(file["nodes"]);
}

}  // namespace swarmanoid
