// Meshes: what their headers claim and what is known of their openings; and, of one input in sixteen, the whole way
// through the process that reads them, as the program does it.
#include <functional>

#include "core/mesh/file_claims.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/parts.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

namespace {

using namespace nextview;

/// The ending of the type that the bytes look like.
const char* extension_of(std::string_view bytes) {
  if (bytes.starts_with("ply")) return ".ply";
  if (bytes.starts_with("OFF")) return ".off";
  if (bytes.starts_with("glTF")) return ".glb";
  if (bytes.starts_with("{")) return ".gltf";
  if (bytes.starts_with("<")) return ".dae";
  if (bytes.starts_with("v ") || bytes.starts_with("#")) return ".obj";
  return ".stl";
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const char* extension : {".ply", ".stl", ".off", ".glb"}) false_claim(extension, bytes);
  const auto openings = fuzzed_file("part.json", bytes);
  is_read([&] { read_openings(openings); });
  if (std::hash<std::string_view>()(bytes) % 16 != 0) return 0;
  const auto file = fuzzed_file(std::string("mesh") + extension_of(bytes), bytes);
  is_read([&] {
    const TriangleMesh mesh = load_mesh(file);
    for (const auto& vertex : mesh.vertices) require(vertex.allFinite(), "vertices are finite");
  });
  return 0;
}
