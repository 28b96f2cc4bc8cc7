#include "core/mesh/weld.hpp"

#include <array>
#include <bit>
#include <unordered_map>

namespace nextview {
namespace {

using Place = std::array<std::uint32_t, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : place) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

}  // namespace

std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3f>& vertices) {
  std::unordered_map<Place, std::uint32_t, PlaceHash> numbers;
  numbers.reserve(vertices.size());
  std::vector<std::uint32_t> places;
  places.reserve(vertices.size());
  for (const Eigen::Vector3f& v : vertices) {
    // Adding +0 turns -0 into +0: the same place, but other bits.
    const Place place = {std::bit_cast<std::uint32_t>(v.x() + 0.0f), std::bit_cast<std::uint32_t>(v.y() + 0.0f),
                         std::bit_cast<std::uint32_t>(v.z() + 0.0f)};
    places.push_back(numbers.try_emplace(place, static_cast<std::uint32_t>(numbers.size())).first->second);
  }
  return places;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> place = weld(mesh.vertices);
  TriangleMesh result;
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] == result.vertices.size()) result.vertices.push_back(mesh.vertices[v]);
  for (const auto& [a, b, c] : mesh.triangles)
    if (place[a] != place[b] && place[b] != place[c] && place[c] != place[a])
      result.triangles.push_back({place[a], place[b], place[c]});
  return result;
}

}  // namespace nextview
