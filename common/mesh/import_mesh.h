// Mesh files of users as Assimp reads them: glTF 2.0 (.glb, .gltf), Wavefront (.obj) and STL. The visualisers make of
// them what is drawn (visualiser/scene/mesh_file.h), mesh_points.h the corners of bodies. Only these two include it:
// it needs Assimp.
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
  // Throws FileError with the reason, without the path; others of Assimp, or of memory. Any thread.
  explicit ImportedMesh(const std::string& path);
  ~ImportedMesh();
  ImportedMesh(const ImportedMesh&) = delete;
  ImportedMesh& operator=(const ImportedMesh&) = delete;

  const aiScene& Scene() const { return *scene_; }
  bool IsGltf() const { return is_gltf_; }

  // Each mesh at each of its nodes. Throws FileError where there are more than kMostMeshTriangles in all.
  void ForEachPart(const std::function<void(const aiMesh& part, const aiMatrix4x4& place)>& take) const;
  // In metres, z up, x to the front. glTF's y is up and its z to the front (its specification, 3.4); the others are
  // taken as they are.
  Eigen::Vector3f ToOurs(const aiVector3D& v) const
  {
    return is_gltf_ ? Eigen::Vector3f(v.z, v.x, v.y) : Eigen::Vector3f(v.x, v.y, v.z);
  }
  // Likewise, of a vertex of a part at its place. Throws FileError for one that is nowhere, or far away.
  Eigen::Vector3f VertexOf(const aiMesh& part, unsigned number, const aiMatrix4x4& place) const;

private:
  std::unique_ptr<Assimp::Importer> importer_;
  const aiScene* scene_ = nullptr;
  bool is_gltf_ = false;
};

}  // namespace swarmanoid
