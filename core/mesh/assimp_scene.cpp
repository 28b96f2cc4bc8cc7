#include "core/mesh/assimp_scene.hpp"

#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <span>
#include <sstream>
#include <stdexcept>

#include "core/mesh/confinement.hpp"
#include "core/mesh/declared_unit.hpp"

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
  if (first + mesh.mNumVertices > max_vertices || all.triangles.size() + mesh.mNumFaces > max_triangles)
    throw std::runtime_error(
        fmt::format("has more than {} million vertices or {} million triangles; thin it out, or export a part of it",
                    max_vertices / 1'000'000, max_triangles / 1'000'000));
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

/// Only the readers of this ending stay: where they do not know a file, Assimp would ask all others what it looks like.
void keep_readers(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::istringstream endings(importer.GetImporterInfo(i)->mFileExtensions);
    std::string ending;
    bool reads = false;
    while (endings >> ending) reads |= "." + ending == extension;
    if (!reads) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

std::runtime_error failure(const Assimp::Importer& importer, const ServedFiles& files) {
  if (files.folder >= 0 && !files.refused.empty())
    return std::runtime_error(
        fmt::format("needs '{}', which is no file beside it or in a folder below; only such are read, and no links",
                    files.refused));
  return std::runtime_error(std::string("cannot be read by Assimp: ") + importer.GetErrorString());
}

}  // namespace

ImportedTriangles read_scene(ServedFiles& files) {
  Assimp::Importer importer;
  keep_readers(importer, files.name.substr(files.name.rfind('.')));
  importer.SetIOHandler(io_system(files, allow_memory_for).release());
  const aiScene* scene = importer.ReadFile(files.name, 0);
  if (!scene || !scene->mRootNode) throw failure(importer, files);
  check_indices(*scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene) throw failure(importer, files);
  ImportedTriangles all;
  append(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), all);
  all.unit = declared_unit(files.name.substr(files.name.rfind('.')), files.bytes, *scene);
  return all;
}

}  // namespace nextview
