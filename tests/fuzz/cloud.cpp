// Clouds: PLY and PCD, plain and compressed.
#include "core/cloud/point_cloud.hpp"
#include "core/recording/cloud_file.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const bool compressed = bytes.starts_with("\x1f\x8b");
  const auto ply = fuzzed_file(compressed ? "cloud.ply.gz" : "cloud.ply", bytes);
  is_read([&] {
    for (const Eigen::Vector3f& point : read_ply(ply)) require(point.allFinite(), "points of a PLY are finite");
  });
  const auto pcd = fuzzed_file(compressed ? "cloud.pcd.gz" : "cloud.pcd", bytes);
  is_read([&] {
    for (const Eigen::Vector3f& point : read_cloud_file(pcd).points)
      require(point.allFinite(), "points of a PCD are finite");
  });
  return 0;
}
