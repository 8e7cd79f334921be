#include "common/experiment/entity_hull.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/configuration/regular_file.h"
#include "common/experiment/mesh_files.h"
#include "common/math/elementary.h"
#include "common/mesh/mesh_points.h"

namespace swarmanoid
{
namespace
{

using Hull = std::shared_ptr<const ConvexHull>;

// Reads "x, y, z; x, y, z; …".
std::optional<std::vector<Vector3>> ParseCorners(std::string_view text)
{
  std::vector<Vector3> corners;
  for (std::size_t at = 0; at <= text.size();)
  {
    const std::size_t end = std::min(text.find(';', at), text.size());
    const std::string_view one = text.substr(at, end - at);
    at = end + 1;
    if (one.find_first_not_of(" \t\n\r") == std::string_view::npos) continue;
    const auto numbers = ParseNumbers(one);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    corners.emplace_back((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  return corners;
}

// Returns the hull of the points, stretched to fill the body.
ConvexHull HullInBody(std::vector<Vector3> points, const EntityConfiguration& entity)
{
  Eigen::AlignedBox3d box;
  for (const Vector3& point : points) box.extend(point);
  const bool stands = DescriptionOf(entity.kind).origin == BodyOrigin::kBase;
  const Vector3 centre(0, 0, stands ? entity.size.z() / 2 : 0);
  const Vector3 smallest = Vector3::Constant(1e-9 * box.sizes().maxCoeff());
  const Vector3 stretch = entity.size.cwiseQuotient(box.sizes().cwiseMax(smallest));
  for (Vector3& point : points) point = centre + (point - box.center()).cwiseProduct(stretch);
  return HullOf(points);
}

// Calls `make` for the first use of `name` and keeps the result. If `make` throws, reports the error at a parameter and
// returns nullptr.
Hull Kept(const std::string& name, const ElementReader& reader, const char* parameter, Reading& reading,
          const std::function<ConvexHull()>& make)
{
  const auto [known, is_new] = reading.hulls.emplace(name, nullptr);
  if (!is_new && known->second) return known->second;
  try
  {
    known->second = std::make_shared<const ConvexHull>(make());
  }
  catch (const std::exception& error)  // FileError of the mesh, std::invalid_argument of its points
  {
    reading.diagnostics.Add(reader.Place(parameter), error.what());
  }
  return known->second;
}

}  // namespace

Hull HullOfEntity(const ElementReader& reader, const EntityConfiguration& entity, Reading& reading)
{
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  if (!kind.corners.empty()) return Kept(kind.tag, reader, "id", reading, [&] { return HullOf(kind.corners); });
  const auto has = [&](std::string_view name)
  { return std::ranges::find(kind.parameters, name, &ParameterSpec::name) != kind.parameters.end(); };
  if (!has("convex") || !reader.IsGood("size")) return nullptr;

  const std::string size = fmt::format("{} {} {}", entity.size.x(), entity.size.y(), entity.size.z());
  if (const std::string text = reader.Text("corners"); !text.empty())
  {
    const auto corners = ParseCorners(text);
    if (!corners)
    {
      reading.diagnostics.Add(reader.Place("corners"), "corners are three numbers each, as in \"0, 0, 0; 1, 0, 0; …\"");
      return nullptr;
    }
    return Kept(fmt::format("{} {} {}", kind.tag, size, text), reader, "corners", reading,
                [&] { return HullInBody(*corners, entity); });
  }
  if (!reader.Boolean("convex")) return nullptr;
  const std::string path = MeshOfEntity(entity, reading.experiment.folder);
  if (path.empty())
  {
    reading.diagnostics.Add(reader.Place("convex"),
                            "it has no 'mesh' whose hull could collide; give it one, or its 'corners'");
    return nullptr;
  }
  // A process on another machine that only shows the run need not have the file. The others report it as missing.
  if (!MeshFileMistake(path).empty()) return nullptr;
  const Vector3 degrees = reader.Vector("mesh_orientation");
  const Quaternion turn = QuaternionFromEuler(
      {DegreesToRadians(degrees.x()), DegreesToRadians(degrees.y()), DegreesToRadians(degrees.z())});
  const std::string name =
      fmt::format("{} {} {} {} {} {}", kind.tag, size, degrees.x(), degrees.y(), degrees.z(), path);
  return Kept(name, reader, "mesh", reading,
              [&]
              {
                try
                {
                  const std::string read = "mesh " + path;
                  Hull& plain = reading.hulls[read];
                  if (!plain) plain = std::make_shared<const ConvexHull>(HullOf(ReadMeshPoints(path).corners));
                  std::vector<Vector3> corners = plain->corners;
                  for (Vector3& corner : corners) corner = turn * corner;
                  return HullInBody(std::move(corners), entity);
                }
                catch (const std::exception& error)
                {
                  throw FileError(fmt::format("'{}': {}", path, error.what()));
                }
              });
}

}  // namespace swarmanoid
