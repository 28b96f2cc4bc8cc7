#include "core/mesh/assimp_scene.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <span>
#include <stdexcept>

namespace nextview {
namespace {

Eigen::Matrix4d to_eigen(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

/// Assimp's triangulation trusts the indices, and not all of its readers check them.
void check_indices(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
      if (face.mNumIndices == 0) throw std::runtime_error("has a face without corners");
      for (const unsigned index : std::span(face.mIndices, face.mNumIndices))
        if (index >= mesh.mNumVertices) throw std::runtime_error("has a face with a vertex that is not there");
    }
  }
}

void append(const aiMesh& mesh, const Eigen::Matrix4d& T_file_mesh, ImportedTriangles& all) {
  const std::size_t first = all.vertices.size();
  if (first + mesh.mNumVertices > UINT32_MAX)
    throw std::runtime_error("has more vertices than 32-bit indices can number");
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    all.vertices.push_back((T_file_mesh * Eigen::Vector4d(p.x, p.y, p.z, 1.0)).head<3>());
  }
  // A mirroring transform turns the triangles inside out unless their order turns with it.
  const bool mirrored = T_file_mesh.topLeftCorner<3, 3>().determinant() < 0.0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const auto index = [&](int i) { return static_cast<std::uint32_t>(first + face.mIndices[i]); };
    all.triangles.push_back({index(0), index(mirrored ? 2 : 1), index(mirrored ? 1 : 2)});
  }
}

void append(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& T_file_parent, ImportedTriangles& all) {
  const Eigen::Matrix4d T_file_node = T_file_parent * to_eigen(node.mTransformation);
  for (unsigned m = 0; m < node.mNumMeshes; ++m) append(*scene.mMeshes[node.mMeshes[m]], T_file_node, all);
  for (unsigned c = 0; c < node.mNumChildren; ++c) append(scene, *node.mChildren[c], T_file_node, all);
}

std::runtime_error failure(const Assimp::Importer& importer) {
  return std::runtime_error(std::string("cannot be read by Assimp: ") + importer.GetErrorString());
}

}  // namespace

bool has_reader(const std::string& extension) { return Assimp::Importer().IsExtensionSupported(extension); }

ImportedTriangles read_scene(const std::filesystem::path& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (!scene || !scene->mRootNode) throw failure(importer);
  check_indices(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene) throw failure(importer);
  ImportedTriangles all;
  append(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), all);
  return all;
}

}  // namespace nextview
