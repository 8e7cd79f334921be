// Reads mesh files of users with Assimp: glTF 2.0 (.glb, .gltf), Wavefront (.obj) and STL. The visualisers make
// drawings from them (visualiser/scene/mesh_file.h), and mesh_points.h makes the corners of bodies. Only these two
// include this header, since it needs Assimp.
#pragma once

#include <assimp/scene.h>

#include <functional>
#include <memory>
#include <string>

#include "common/math/pose.h"

namespace Assimp
{
class Importer;
}

namespace swarmanoid
{

class ImportedMesh
{
public:
  // Throws FileError with the reason, without the path. Assimp may throw other exceptions, such as for memory. Any
  // thread may call it.
  explicit ImportedMesh(const std::string& path);
  ~ImportedMesh();
  ImportedMesh(const ImportedMesh&) = delete;
  ImportedMesh& operator=(const ImportedMesh&) = delete;

  const aiScene& Scene() const { return *scene_; }
  bool IsGltf() const { return is_gltf_; }

  // Calls `take` with each mesh at each of its nodes. Throws FileError if they have more than kMostMeshTriangles in
  // all.
  void ForEachPart(const std::function<void(const aiMesh& part, const aiMatrix4x4& place)>& take) const;
  // Returns the vector in metres, z up, x to the front. In glTF, y is up and z is to the front (its specification,
  // 3.4). The other formats are taken as they are.
  Eigen::Vector3f ToOurs(const aiVector3D& v) const
  {
    return is_gltf_ ? Eigen::Vector3f(v.z, v.x, v.y) : Eigen::Vector3f(v.x, v.y, v.z);
  }
  // Returns a vertex of a part at its place, in the same frame. Throws FileError for a vertex that is not finite or too
  // far away.
  Eigen::Vector3f VertexOf(const aiMesh& part, unsigned number, const aiMatrix4x4& place) const;

private:
  std::unique_ptr<Assimp::Importer> importer_;
  const aiScene* scene_ = nullptr;
  bool is_gltf_ = false;
};

}  // namespace swarmanoid
