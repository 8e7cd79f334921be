#include "visualiser/scene/meshes_file.h"

#include <fmt/format.h>

#include "visualiser/scene/meshes.h"

namespace swarmanoid
{
namespace
{

using Buffer = fmt::memory_buffer;

template <class... Arguments>
void Append(Buffer& text, fmt::format_string<Arguments...> format, Arguments&&... arguments)
{
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

// "name": [a, b ...] of what `write` appends for each element, with commas between.
template <class Range, class Write>
void AppendList(Buffer& text, std::string_view name, const Range& range, const Write& write)
{
  Append(text, "\"{}\":[", name);
  bool first = true;
  for (const auto& element : range)
  {
    if (!first) text.push_back(',');
    first = false;
    write(element);
  }
  text.push_back(']');
}

void AppendVector(Buffer& text, const Eigen::Vector3f& vector)
{
  Append(text, "{:.5g},{:.5g},{:.5g}", vector.x(), vector.y(), vector.z());
}

void AppendMesh(Buffer& text, const Mesh& mesh)
{
  text.push_back('{');
  AppendList(text, "positions", mesh.vertices, [&](const MeshVertex& v) { AppendVector(text, v.position); });
  text.push_back(',');
  AppendList(text, "normals", mesh.vertices, [&](const MeshVertex& v) { AppendVector(text, v.normal); });
  text.push_back(',');
  AppendList(text, "materials", mesh.vertices,
             [&](const MeshVertex& v) { Append(text, "{}", static_cast<int>(v.material)); });
  text.push_back(',');
  AppendList(text, "shades", mesh.vertices, [&](const MeshVertex& v) { Append(text, "{:.3g}", v.shade); });
  text.push_back(',');
  AppendList(text, "indices", mesh.indices, [&](std::uint32_t index) { Append(text, "{}", index); });
  text.push_back('}');
}

void AppendMaterial(Buffer& text, int number)
{
  const MaterialLook& look = LookOf(static_cast<Material>(number));
  Append(text, R"({{"name":"{}","colour":{},"gloss":{:.3g},"opacity":{:.3g},"tint":{},"light":{}}})", look.name,
         look.colour, look.gloss, look.opacity, look.takes_tint, look.led);
}

void AppendRobot(Buffer& text, EntityKind robot)
{
  AppendList(text, TagName(robot), RestingParts(robot),
             [&](const RestingPart& part)
             {
               Append(text, R"({{"model":"{}",)", ModelOf(part.model).name);
               const Eigen::Matrix4f matrix = part.place.matrix();
               AppendList(text, "matrix", std::span(matrix.data(), 16),
                          [&](float value) { Append(text, "{:.6g}", value); });
               text.push_back('}');
             });
}

}  // namespace

std::string MeshesAsJson()
{
  Buffer text;
  text.push_back('{');
  std::vector<int> materials;
  for (int m = 0; m < static_cast<int>(Material::kEnd); ++m) materials.push_back(m);
  AppendList(text, "materials", materials, [&](int number) { AppendMaterial(text, number); });

  Append(text, ",\"models\":{{");
  bool first = true;
  for (const Model& model : StandardModels())
  {
    Append(text, R"({}"{}":{{"radius":{:.5g},)", first ? "" : ",", model.name, model.radius);
    first = false;
    AppendList(text, "levels", model.levels, [&](const Mesh& mesh) { AppendMesh(text, mesh); });
    text.push_back('}');
  }

  Append(text, "}},\"robots\":{{");
  AppendRobot(text, EntityKind::kFootbot);
  text.push_back(',');
  AppendRobot(text, EntityKind::kEyebot);
  text.push_back(',');
  AppendRobot(text, EntityKind::kHandbot);
  Append(
      text,
      R"(}},"palette":{{"sky":{},"floor":{},"floor_line":{},"outside":{},"wall":{},"hole":{},"selection":{},"label":{}}}}})",
      palette::kSky, palette::kFloor, palette::kFloorLine, palette::kOutside, palette::kWall, palette::kHole,
      palette::kSelection, palette::kLabel);
  return fmt::to_string(text);
}

}  // namespace swarmanoid
