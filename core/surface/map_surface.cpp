#include "core/surface/map_surface.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/surface/isosurface.hpp"
#include "core/surface/solid_voxels.hpp"

namespace nextview {
namespace {

/// Values this near to the level are moved off it, so that no two vertices come to lie at one place.
constexpr float off_level = 1e-3f;
/// In the middle of a thin wall, at most: the surface runs an eighth of a voxel edge off it on both sides.
constexpr float thin_value = 2.0f / 3.0f;
/// Of the solid voxels whose centres are this near to a vertex, half must be measured for it to be seen [voxel edges].
constexpr double seen_within = 0.9;

/// The voxels that contain a point of a lattice of half the grid's spacing: 1 at a voxel's centre, 2 on a face, 4 on an
/// edge, 8 at a corner. Points are counted from the grid's lowest corner.
struct VoxelsAround {
  Eigen::Vector3i lowest, highest;

  explicit VoxelsAround(const Eigen::Vector3i& point) {
    for (int k = 0; k < 3; ++k) {
      highest[k] = point[k] >> 1;
      lowest[k] = point[k] & 1 ? highest[k] : highest[k] - 1;
    }
  }

  template <class Visit>
  void for_each(Visit visit) const {
    for (int z = lowest.z(); z <= highest.z(); ++z)
      for (int y = lowest.y(); y <= highest.y(); ++y)
        for (int x = lowest.x(); x <= highest.x(); ++x) visit(Eigen::Vector3i(x, y, z));
  }
};

/// The voxels that hold everything solid.
Eigen::AlignedBox3i solid_box(const VoxelGrid& grid, std::span<const float> solid) {
  Eigen::AlignedBox3i box;
  for (std::uint32_t v = 0; v < solid.size(); ++v)
    if (solid[v] >= solid_from) box.extend(grid.cell(v));
  return box;
}

/// How far inside the object each point of a lattice of half the grid's spacing is. At corners of voxels the least
/// solid of the eight decides, between corners their mean. Points that only solid voxels contain are never outside: so
/// edges stay sharp and thin walls whole.
class InsideField {
 public:
  explicit InsideField(const SolidPart& part)
      : grid_(part.grid),
        offset_(part.offset),
        solid_(part.solid),
        walls_(wall_voxels(grid_, solid_)),
        box_(solid_box(grid_, solid_)),
        corners_{grid_.resolution, box_.min() - Eigen::Vector3i::Ones(), box_.sizes() + Eigen::Vector3i::Constant(4)},
        at_corners_(corners_.voxel_count()) {
    tbb::parallel_for(0, corners_.size.z(), [&](int z) {
      for (int y = 0; y < corners_.size.y(); ++y)
        for (int x = 0; x < corners_.size.x(); ++x)
          at_corners_[corners_.index({x, y, z})] = least_around(corners_.first + Eigen::Vector3i(x, y, z));
    });
  }

  ScalarField make() const {
    const Eigen::Vector3i first = 2 * box_.min() - Eigen::Vector3i::Ones();  // a point outside on every side
    ScalarField field;
    field.size = 2 * box_.sizes() + Eigen::Vector3i::Constant(5);
    field.spacing = 0.5 * grid_.resolution;
    // From the map's corner: the same place to the last bit, whatever part of it is looked at.
    const Vector3 lower = (grid_.first - offset_).cast<double>() * grid_.resolution;
    field.origin = lower + field.spacing * (first + 2 * offset_).cast<double>();
    field.values.resize(field.point_count());
    tbb::parallel_for(0, field.size.z(), [&](int z) {
      for (int y = 0; y < field.size.y(); ++y)
        for (int x = 0; x < field.size.x(); ++x) {
          const float value = at(first + Eigen::Vector3i(x, y, z)), off = value - solid_from;
          field.values[field.index({x, y, z})] =
              std::abs(off) >= off_level ? value : solid_from + std::copysign(off_level, off);
        }
    });
    return field;
  }

 private:
  float solid(const Eigen::Vector3i& cell) const { return grid_.contains(cell) ? solid_[grid_.index(cell)] : 0.0f; }

  float least_around(const Eigen::Vector3i& corner) const {
    float least = 1.0f;
    VoxelsAround(2 * corner).for_each([&](const Eigen::Vector3i& cell) { least = std::min(least, solid(cell)); });
    return least;
  }

  float at(const Eigen::Vector3i& point) const {
    float sum = 0.0f, least = 1.0f;
    int corners = 0;
    bool any_thin = false, all_thin = true;
    // The corners around a point are to it what the voxels are, half a voxel on.
    VoxelsAround(point + Eigen::Vector3i::Ones()).for_each([&](const Eigen::Vector3i& corner) {
      sum += at_corners_[corners_.index(corner - corners_.first)];
      ++corners;
    });
    VoxelsAround(point).for_each([&](const Eigen::Vector3i& cell) {
      least = std::min(least, solid(cell));
      const Wall wall = grid_.contains(cell) ? walls_[grid_.index(cell)] : Wall::none;
      any_thin |= wall == Wall::thin;
      all_thin &= wall == Wall::thin || wall == Wall::step;
    });
    const float mean = sum / float(corners);
    return any_thin || all_thin ? std::max(mean, std::min(least, thin_value)) : mean;
  }

  const VoxelGrid& grid_;
  Eigen::Vector3i offset_;
  std::span<const float> solid_;
  std::vector<Wall> walls_;
  Eigen::AlignedBox3i box_;        ///< of what is solid
  VoxelGrid corners_;              ///< of its voxels and of those beside it, numbered as voxels are
  std::vector<float> at_corners_;  ///< as many points share each
};

/// Between points of the lattice, trilinear.
double interpolate(const ScalarField& field, const Vector3& point) {
  const Eigen::Vector3i last = field.size - Eigen::Vector3i::Constant(2);
  const Vector3 place = (point - field.origin) / field.spacing;
  const Eigen::Vector3i cell =
      place.array().floor().matrix().cast<int>().cwiseMax(Eigen::Vector3i::Zero()).cwiseMin(last);
  const Vector3 t = (place - cell.cast<double>()).cwiseMax(0.0).cwiseMin(1.0);
  double value = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3i step(k & 1, k >> 1 & 1, k >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? t[axis] : 1.0 - t[axis];
    value += weight * field.values[field.index(cell + step)];
  }
  return value;
}

float uncertainty(const ScalarField& field, const Vector3& vertex, double largest) {
  Vector3 slope;  // on the steeper side: a thin wall's two sides would cancel
  const double step = 0.5 * field.spacing, here = interpolate(field, vertex);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 way = step * Vector3::Unit(axis);
    const double ahead = interpolate(field, vertex + way) - here, behind = here - interpolate(field, vertex - way);
    slope[axis] = (std::abs(ahead) > std::abs(behind) ? ahead : behind) / step;
  }
  return static_cast<float>(std::min(0.25 / slope.norm(), largest));
}

bool is_seen(const SolidPart& part, const Vector3& vertex) {
  const VoxelGrid& grid = part.grid;
  int near = 0, measured = 0;
  const Eigen::Vector3i centre = grid.cell_at(vertex);
  for (int k = 0; k < 27; ++k) {
    const Eigen::Vector3i cell = centre + Eigen::Vector3i(k % 3, k / 3 % 3, k / 9) - Eigen::Vector3i::Ones();
    if (!grid.contains(cell)) continue;
    const std::uint32_t v = grid.index(cell);
    if (part.solid[v] < solid_from || (grid.centre(v) - vertex).norm() > seen_within * grid.resolution) continue;
    ++near;
    measured += part.measured[v];
  }
  return near > 0 && 2 * measured >= near;
}

/// Of bricks whose voxels are all the same one of them is asked.
template <class Is>
bool any_voxel(const VoxelBricks& voxels, Is is) {
  return std::ranges::any_of(voxels.bricks(), [&](const auto& brick) {
    bool found = false;
    const std::size_t count = brick->is_uniform() ? 1 : VoxelBricks::brick_voxels;
    for (std::size_t i = 0; i < count && !found; ++i) found = is((*brick)[i]);
    return found;
  });
}

}  // namespace

Surface map_surface(const VoxelGrid& grid, std::span<const Voxel> voxels) {
  if (voxels.size() != grid.voxel_count())
    throw std::invalid_argument("surface of a map: the voxels are not as many as the grid's");
  return map_surface(grid, VoxelBricks(grid.size, voxels));
}

Surface map_surface(const VoxelGrid& grid, const VoxelBricks& voxels, std::optional<double> prior) {
  if (voxels.edges() != grid.size)
    throw std::invalid_argument("surface of a map: the voxels are not as many as the grid's");
  if (any_voxel(voxels, [](const Voxel& voxel) { return !std::isfinite(voxel.probability); }))
    throw std::invalid_argument("surface of a map: a probability is not a number");
  const DecidedVoxels decided(prior);
  Surface surface;
  const std::optional<SolidPart> part = solid_part(grid, voxels, decided);
  if (!part) {
    const bool measured = any_voxel(voxels, [](const Voxel& voxel) { return voxel.measured; });
    surface.why_empty = measured ? "no voxel is occupied" : "nothing has been measured yet";
    return surface;
  }
  const ScalarField field = InsideField(*part).make();
  surface.mesh = isosurface(field, solid_from);
  const std::size_t vertices = surface.mesh.vertices.size();
  surface.uncertainty.resize(vertices);
  surface.seen.resize(vertices);
  tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
    const Vector3 vertex = surface.mesh.vertices[v].cast<double>();
    surface.uncertainty[v] = uncertainty(field, vertex, grid.resolution);
    surface.seen[v] = is_seen(*part, vertex);
  });
  return surface;
}

}  // namespace nextview
