#include "common/configuration/regular_file.h"
#include "common/mesh/import_mesh.h"
#include "common/mesh/mesh_points.h"

namespace swarmanoid
{
namespace
{

MeshPoints PointsIn(const ImportedMesh& mesh)
{
  MeshPoints points;
  mesh.ForEachPart(
      [&](const aiMesh& part, const aiMatrix4x4& place)
      {
        const auto first = static_cast<std::uint32_t>(points.corners.size());
        for (unsigned v = 0; v < part.mNumVertices; ++v)
          points.corners.push_back(mesh.VertexOf(part, v, place).cast<double>());
        for (unsigned f = 0; f < part.mNumFaces; ++f)
        {
          const aiFace& face = part.mFaces[f];
          if (face.mNumIndices != 3) continue;
          const unsigned* const index = face.mIndices;
          points.triangles.push_back({first + index[0], first + index[1], first + index[2]});
        }
      });
  if (points.triangles.empty()) throw FileError("it has no triangles");
  return points;
}

}  // namespace

void ImportMeshPoints(const std::string& path, MeshPoints& points)
{
  try
  {
    points = PointsIn(ImportedMesh(path));
  }
  catch (const FileError&)
  {
    throw;
  }
  catch (const std::exception& error)  // an error of Assimp or of memory
  {
    throw FileError(error.what());
  }
}

}  // namespace swarmanoid
