// Writes the models as JSON for pages. Numbers have as many digits as a picture needs, and indices are differences, so
// that the compressed file is small.
#include "visualiser/scene/meshes_json.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "visualiser/scene/floor_grid.h"
#include "visualiser/scene/meshes.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

// A picture needs no more digits, and a shorter file loads faster.
Json Rounded(double value, int digits) { return Json::parse(fmt::format("{:.{}g}", value, digits)); }

template <class Range, class Value>
Json List(const Range& range, const Value& value)
{
  Json list = Json::array();
  for (const auto& element : range) list.push_back(value(element));
  return list;
}

void AddVector(Json& list, const Eigen::Vector3f& vector)
{
  for (const float number : vector) list.push_back(Rounded(number, 5));
}

Json MeshOf(const Mesh& mesh)
{
  Json positions = Json::array(), normals = Json::array(), materials = Json::array(), shades = Json::array(),
       colours = Json::array();
  bool is_painted = false;
  for (const MeshVertex& vertex : mesh.vertices)
  {
    AddVector(positions, vertex.position);
    AddVector(normals, vertex.normal);
    materials.push_back(static_cast<int>(vertex.material));
    shades.push_back(Rounded(vertex.shade, 3));
    colours.push_back(vertex.colour);
    is_painted |= vertex.material == Material::kPainted;
  }
  // Neighbouring corners have near numbers, so their differences compress to half the size.
  Json steps = Json::array();
  std::int64_t last = 0;
  for (const std::int64_t index : mesh.indices)
  {
    steps.push_back(index - last);
    last = index;
  }
  Json written{{"positions", positions},
               {"normals", normals},
               {"materials", materials},
               {"shades", shades},
               {"index_steps", steps}};
  if (is_painted) written["colours"] = colours;
  return written;
}

Json JsonOf(const Model& model)
{
  return {{"radius", Rounded(model.radius, 5)}, {"levels", List(model.levels, MeshOf)}};
}

Json MaterialOf(const MaterialLook& look)
{
  return {{"name", look.name},
          {"colour", look.colour},
          {"gloss", Rounded(look.gloss, 3)},
          {"opacity", Rounded(look.opacity, 3)},
          {"tint", look.takes_tint},
          {"painted", look.is_painted},
          {"light", look.led}};
}

Json RestingRobot(Mechanism robot)
{
  return List(RestingParts(robot),
              [](const RestingPart& part) -> Json
              {
                const Eigen::Matrix4f matrix = part.place.matrix();
                const auto number = [](float value) { return Rounded(value, 6); };
                return {{"model", ModelOf(part.model).name}, {"matrix", List(std::span(matrix.data(), 16), number)}};
              });
}

}  // namespace

std::string ModelAsJson(const Model& model) { return JsonOf(model).dump(); }

std::string MeshesAsJson()
{
  Json file;
  file["materials"] = Json::array();
  for (int m = 0; m < static_cast<int>(Material::kEnd); ++m)
    file["materials"].push_back(MaterialOf(LookOf(static_cast<Material>(m))));
  for (const Model& model : StandardModels()) file["models"][model.name] = JsonOf(model);
  for (std::size_t k = 0; k < EntityKindCount(); ++k)
    if (const auto& kind = DescriptionOf(static_cast<EntityKind>(k)); kind.mechanism != Mechanism::kNone)
      file["robots"][kind.tag] = RestingRobot(kind.mechanism);
  file["palette"] = {{"sky", palette::kSky},
                     {"floor", palette::kFloor},
                     {"floor_line", palette::kFloorLine},
                     {"outside", palette::kOutside},
                     {"wall", palette::kWall},
                     {"hole", palette::kHole},
                     {"selection", palette::kSelection},
                     {"label", palette::kLabel},
                     {"collision", palette::kCollision},
                     {"ray_free", palette::kRayFree},
                     {"ray_hit", palette::kRayHit}};
  file["floor_grid"] = {{"spacings", kFloorSpacings}, {"most_cells", kMostFloorCells}};
  return file.dump();
}

}  // namespace swarmanoid
