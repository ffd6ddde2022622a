#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <stdexcept>

#include "field_fusion/core/sim/shapes.h"

namespace field_fusion::core::sim {

Mesh loadMesh(const std::string& file, double scale) {
  Assimp::Importer importer;
  // else a Collada file with z up is turned until y is; RViz and Gazebo leave the axes as they are, too
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // one frame for all: what a file says of places and axes is applied to the vertices
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                                     aiProcess_SortByPType | aiProcess_JoinIdenticalVertices);
  if (!scene) throw std::runtime_error(file + ": cannot be read as a mesh: " + importer.GetErrorString());
  Mesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& from = *scene->mMeshes[m];
    Mesh part;
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      const aiVector3D& v = from.mVertices[i];
      part.vertices.push_back((scale * Eigen::Vector3d(v.x, v.y, v.z)).cast<float>());
      if (!part.vertices.back().allFinite()) throw std::runtime_error(file + ": has a vertex that is not finite");
    }
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      const aiFace& face = from.mFaces[i];
      if (face.mNumIndices == 3)
        part.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    }
    mesh.add(part);
  }
  if (mesh.triangles.empty()) throw std::runtime_error(file + ": has no triangles");
  return mesh;
}

}  // namespace field_fusion::core::sim
