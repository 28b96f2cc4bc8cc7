#pragma once
#include <filesystem>
#include <string>

#include "core/file/atomic_file.hpp"
#include "core/file/gzip_file.hpp"

namespace nextview {

/// The sets that come with the tests: tests/data/README.md.
inline constexpr const char* conformance_sets[] = {"scans1", "scans6"};

inline std::filesystem::path conformance_file(const std::string& name) {
  return std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "tests/data/conformance" / name;
}

/// Unpacks a set's scene into `folder`; returns the file.
inline std::filesystem::path unpack_conformance_scene(const std::string& set, const std::filesystem::path& folder) {
  const std::filesystem::path scene = folder / (set + ".txt");
  write_file(scene, read_gzip_file(conformance_file(set + ".txt.gz")));
  return scene;
}

}  // namespace nextview
