// Writes the parts of our own, which lie in assets/objects, anew: make_objects [folder]
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/file/atomic_file.hpp"
#include "core/mesh/parts.hpp"

int main(int argc, char** argv) try {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "assets/objects";
  std::filesystem::create_directories(folder);
  for (const nextview::Part& part :
       {nextview::slotted_plate(), nextview::slotted_housing(), nextview::sphere_part(), nextview::box_part()}) {
    nextview::write_file(folder / (part.name + ".ply"), nextview::ply_bytes(part.mesh));
    if (!part.openings.empty()) nextview::write_file(folder / (part.name + ".json"), nextview::openings_json(part));
    fmt::print("{}: {} triangles, {}\n", part.name, part.mesh.triangles.size(),
               nextview::topology(part.mesh).summary());
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "make_objects: {}\n", error.what());
  return 1;
}
