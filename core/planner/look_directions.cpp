#include "core/planner/look_directions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/map/traversal.hpp"
#include "core/view/candidate_views.hpp"

namespace nextview {
namespace {

constexpr int few = 64, many = 768;         // directions; neighbours are 25 and 7 degrees apart
constexpr std::size_t enough = 6;           // open ones of the few
constexpr double likely = 0.5;              // chance of getting out
constexpr double other_cone = 0.5;          // cosine, of 60 degrees: beyond, it is another one
constexpr double least_other_share = 0.25;  // as open as that it is worth a look

std::vector<Vector3> over_sphere(int count) {
  CandidateViewsConfig lattice;
  lattice.layout = ViewLayout::fibonacci;
  lattice.count = count;
  lattice.radius = 1.0;
  std::vector<Vector3> directions;
  for (const Pose& pose : candidate_views(lattice, Vector3::Zero()))
    directions.push_back(pose.translation().normalized());
  return directions;
}

/// The middle of the open directions about the one with most of them about it, and how much that is.
std::pair<double, Vector3> most_open(const std::vector<Vector3>& directions) {
  double most = 0.0;
  Vector3 axis = Vector3::Zero();
  for (const Vector3& direction : directions) {
    double open = 0.0;
    Vector3 sum = Vector3::Zero();
    for (const Vector3& other : directions) {
      const double cosine = other.dot(direction);
      if (cosine <= 0.0) continue;
      open += cosine;
      sum += other;
    }
    if (open > most) most = open, axis = sum.normalized();
  }
  return {most, axis};
}

}  // namespace

LookDirections::LookDirections(const NewSurfaceField& field)
    : field_(field), few_(over_sphere(few)), many_(over_sphere(many)) {}

bool LookDirections::gets_out(const Vector3& place, const Vector3& direction) const {
  const VoxelGrid& grid = field_.grid();
  const Eigen::Vector3i own = grid.cell_at(place);
  double out = 1.0;
  walk_ray_segments(grid, place, direction, std::numeric_limits<double>::max(),
                    [&](int x, int y, int z, double, double) {
                      if (own == Eigen::Vector3i(x, y, z)) return true;
                      const float chance = field_.at(x, y, z);
                      out *= chance < 0.0f ? 0.0 : 1.0 - chance;
                      return out >= likely;
                    });
  return out >= likely;
}

LookDirections::Open LookDirections::from(const Vector3& place) const {
  const auto open_of = [&](const std::vector<Vector3>& directions) {
    std::vector<Vector3> open;
    std::ranges::copy_if(directions, std::back_inserter(open), [&](const Vector3& d) { return gets_out(place, d); });
    return open;
  };
  Open open{open_of(few_), {}};
  if (open.directions.size() < enough) open.directions = open_of(many_);
  std::vector<Vector3> others = open.directions;
  double first = 0.0;
  while (open.axes.size() < 2) {
    const auto [most, middle] = most_open(others);
    if (most == 0.0 || most < least_other_share * first) break;
    if (first == 0.0) first = most;
    // Between two narrow cones nothing may get out: then rather the open direction that is nearest.
    const auto nearest = std::ranges::max_element(others, {}, [&m = middle](const Vector3& d) { return d.dot(m); });
    const Vector3 axis = gets_out(place, middle) ? middle : *nearest;
    open.axes.push_back(axis);
    std::erase_if(others, [&](const Vector3& d) { return d.dot(axis) > other_cone; });
  }
  return open;
}

std::vector<Vector3> frontier_places(const NewSurfaceField& field, const SurfaceEvidence& evidence, std::size_t count,
                                     double shift) {
  const VoxelGrid& grid = field.grid();
  const auto is_free = [&](int x, int y, int z) { return evidence.kind({x, y, z}) == SurfaceEvidence::Kind::free; };
  std::vector<std::uint32_t> frontier;
  std::vector<double> until;  // sum of chances
  double all = 0.0;
  for (int z = 1; z + 1 < grid.size.z(); ++z)
    for (int y = 1; y + 1 < grid.size.y(); ++y)
      evidence.all_that_may_hold_surface().for_each_in_row(y, z, [&](int x) {
        if (x == 0 || x + 1 == grid.size.x() || field.at(x, y, z) == 0.0f || is_free(x, y, z)) return;
        if (!is_free(x - 1, y, z) && !is_free(x + 1, y, z) && !is_free(x, y - 1, z) && !is_free(x, y + 1, z) &&
            !is_free(x, y, z - 1) && !is_free(x, y, z + 1))
          return;
        frontier.push_back(grid.index({x, y, z}));
        until.push_back(all += std::abs(field.at(x, y, z)));
      });
  std::vector<Vector3> places;
  for (std::size_t k = 0; k < count && !frontier.empty(); ++k) {
    const double at = all * (double(k) + shift) / double(count);
    const auto found = std::min(std::ranges::upper_bound(until, at), until.end() - 1);
    places.push_back(grid.centre(frontier[std::size_t(found - until.begin())]));
  }
  return places;
}

}  // namespace nextview
