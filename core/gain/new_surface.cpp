#include "core/gain/new_surface.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/map/traversal.hpp"

namespace nextview {
namespace {

constexpr double negligible = 1e-3;  // reach at which a ray is given up

/// Calls `visit(x, y, z, reach, area)` for the voxels of the field on a ray: how likely it gets there, and how much new
/// surface it finds there, across the ray and per solid angle [m^2]. What find_along_rays does for many rays at once,
/// as it is meant to be read.
template <class Visit>
void follow(const NewSurfaceField& field, const Vector3& origin, const Vector3& direction, double length, Visit visit) {
  const VoxelGrid& grid = field.grid();
  double reach = 1.0;
  walk_ray_segments(grid, origin, direction, length, [&](int x, int y, int z, double enter, double exit) {
    const float chance = field.at(x, y, z);
    if (chance == 0.0f) return true;
    const double found = reach * std::abs(chance), range = 0.5 * (enter + exit);
    visit(x, y, z, reach, found * range * range);
    reach -= found;
    return chance > 0.0f && reach > negligible;
  });
}

}  // namespace

NewSurfaceField::NewSurfaceField(const SurfaceEvidence& evidence, const NewSurfaceModel& model)
    : grid_(evidence.grid()), chances_(places_with_margin(grid_)), normals_(chances_.size()) {
  fill_margin_layers(grid_, chances_, ChanceField::outside);
  tbb::parallel_for(0, evidence.unmeasured_blocks().size().z(),
                    [&](int block_z) { fill_layer_of_blocks(evidence, model, block_z); });
}

void NewSurfaceField::fill_layer_of_blocks(const SurfaceEvidence& evidence, const NewSurfaceModel& model, int block_z) {
  const BitRows& unmeasured = evidence.unmeasured_blocks();
  const int edge = evidence.block_edge();
  struct Block {
    float chance = 0.0f;                      ///< if it holds an unmeasured voxel
    std::optional<CoarseNormal> normal = {};  ///< once it was asked for
  };
  std::vector<Block> row(std::size_t(unmeasured.size().x()));
  for (int block_y = 0; block_y < unmeasured.size().y(); ++block_y) {
    std::ranges::fill(row, Block());
    unmeasured.for_each_in_row(block_y, block_z, [&](int x) {
      row[std::size_t(x)].chance = model.chance_in_block(evidence, {x, block_y, block_z});
    });
    for (int z = edge * block_z; z < std::min(edge * (block_z + 1), grid_.size.z()); ++z)
      for (int y = edge * block_y; y < std::min(edge * (block_y + 1), grid_.size.y()); ++y) {
        const std::size_t first = place_with_margin(grid_, 0, y, z);
        std::fill_n(&chances_[first], grid_.size.x(), 0.0f);
        fill_margin_of_row(grid_, y, z, chances_, ChanceField::outside);
        evidence.all_that_may_hold_surface().for_each_in_row(y, z, [&](int x) {
          Block& block = row[std::size_t(x / edge)];
          if (!block.normal) block.normal = evidence.normal({x / edge, block_y, block_z});
          normals_[first + std::size_t(x)] = *block.normal;
          chances_[first + std::size_t(x)] = evidence.kind({x, y, z}) == SurfaceEvidence::Kind::unmeasured
                                                 ? block.chance
                                                 : model.chance(evidence, {x, y, z});
        });
      }
  }
}

namespace {

/// Rays whose areas are added up on their own, and the sums in their order: so that two views of many rays keep more
/// than two threads busy, and a score and what explains it round alike.
constexpr std::size_t rays_a_part = 1024;

/// Some of a bundle's rays.
struct RayRange {
  const RayBundle& bundle;
  std::size_t begin, end;
};

/// The new surface that a view's rays are expected to see [cm^2]. Calls `visit(place, area)` for where.
template <class Visit>
double area_seen(const NewSurfaceField& field, const Pose& view, const RayRange& rays, const NewSurfaceOptions& options,
                 Visit visit) {
  std::vector<Vector3> directions;
  for (std::size_t ray = rays.begin; ray < rays.end; ++ray)
    directions.emplace_back(view.linear() * rays.bundle.directions[ray]);
  const Finds finds = find_along_rays({field.grid(), view.translation(), directions, options.ray_length},
                                      {field.chances(), negligible});
  double area = 0.0;
  for (std::size_t ray = 0; ray < directions.size(); ++ray) {
    const double worth = square_centimetres_of_a_square_metre * rays.bundle.solid_angles[rays.begin + ray];
    for (std::size_t i = finds.begins[ray]; i < finds.ends[ray]; ++i) {
      const Finds::Find& find = finds.finds[i];
      const double slant = options.slant.at(field.normals()[find.place].squared_cosine(directions[ray]));
      const double found = worth * slant * find.area;
      visit(find.place, found);
      area += found;
    }
  }
  return area;
}

/// Blocks of 8 x 8 x 8 voxels.
class Parts {
 public:
  explicit Parts(const VoxelGrid& grid)
      : row_(std::uint32_t(grid.size.x()) + 2),
        layer_(row_ * (std::uint32_t(grid.size.y()) + 2)),
        parts_((grid.size.array() + 7) / 8) {}

  std::size_t count() const { return std::size_t(parts_.prod()); }
  /// In which a voxel lies, by its place with margin.
  std::size_t of(std::uint32_t place) const {
    const std::uint32_t z = whole(place * per_layer_), in_layer = place - z * layer_;
    const std::uint32_t y = whole(in_layer * per_row_), x = in_layer - y * row_;
    return (part_of(z) * std::size_t(parts_.y()) + part_of(y)) * std::size_t(parts_.x()) + part_of(x);
  }

 private:
  /// Rounded down; a quotient that is whole may have come out a little less. Divisions of integers take longer.
  static std::uint32_t whole(double quotient) { return static_cast<std::uint32_t>(quotient + 1e-8); }
  static std::size_t part_of(std::uint32_t with_margin) { return (with_margin - 1) / 8; }

  std::uint32_t row_, layer_;
  double per_row_ = 1.0 / row_, per_layer_ = 1.0 / layer_;
  Eigen::Vector3i parts_;  ///< along each axis
};

}  // namespace

std::vector<double> expected_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                         const RayBundle& bundle, const NewSurfaceOptions& options,
                                         std::stop_token stop) {
  const std::size_t rays = bundle.directions.size(), parts = (rays + rays_a_part - 1) / rays_a_part;
  std::vector<double> of_parts(views.size() * parts, 0.0);
  tbb::parallel_for(std::size_t{0}, of_parts.size(), [&](std::size_t i) {
    const std::size_t begin = i % parts * rays_a_part;
    const RayRange range{bundle, begin, std::min(begin + rays_a_part, rays)};
    if (!stop.stop_requested()) of_parts[i] = area_seen(field, views[i / parts], range, options, [](auto...) {});
  });
  std::vector<double> areas(views.size(), 0.0);
  for (std::size_t i = 0; i < of_parts.size(); ++i) areas[i / parts] += of_parts[i];
  return areas;
}

NewSurfaceForecast forecast_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                        const RayBundle& bundle, const NewSurfaceOptions& options,
                                        std::stop_token stop) {
  const Parts parts(field.grid());
  NewSurfaceForecast forecast;
  forecast.most.assign(parts.count(), 0.0f);
  forecast.areas.assign(views.size(), 0.0);
  forecast.parts.assign(views.size(), forecast.most);
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (stop.stop_requested()) return;
    std::vector<float>& of_parts = forecast.parts[v];
    const RayRange all{bundle, 0, bundle.directions.size()};
    forecast.areas[v] = area_seen(field, views[v], all, options, [&](std::uint32_t place, double area) {
      of_parts[parts.of(place)] += static_cast<float>(area);
    });
  });
  for (std::size_t part = 0; part < forecast.most.size(); ++part) {
    float& most = forecast.most[part];
    for (const std::vector<float>& of_view : forecast.parts) most = std::max(most, of_view[part]);
    forecast.all += most;
  }
  return forecast;
}

std::vector<NewSurfaceInVoxel> new_surface_in_voxels(const NewSurfaceField& field, const Pose& T_world_camera,
                                                     const RayBundle& bundle, const NewSurfaceOptions& options) {
  std::vector<NewSurfaceInVoxel> voxels;
  const RayRange all{bundle, 0, bundle.directions.size()};
  const VoxelGrid& grid = field.grid();
  area_seen(field, T_world_camera, all, options, [&](std::uint32_t place, double area) {
    const Eigen::Vector3i lattice = grid.first + cell_of_place(grid, place);
    voxels.push_back({(lattice.cast<double>() + Vector3::Constant(0.5)) * grid.resolution, area});
  });
  return voxels;
}

ScoreExplanation explain_new_surface(const NewSurfaceField& field, const VoxelGrid& grid, const VoxelBricks& voxels,
                                     const Pose& T_world_camera, const RayBundle& bundle,
                                     const NewSurfaceOptions& options) {
  ScoreExplanation explanation;
  explanation.rays.resize(bundle.directions.size());
  tbb::parallel_for(std::size_t{0}, bundle.directions.size(), [&](std::size_t i) {
    ScoreExplanation::RayPart& part = explanation.rays[i];
    part.direction = T_world_camera.linear() * bundle.directions[i];
    const double worth = square_centimetres_of_a_square_metre * bundle.solid_angles[i];
    follow(field, T_world_camera.translation(), part.direction, options.ray_length,
           [&](int x, int y, int z, double reach, double area) {
             const double slant = options.slant.at(field.normal(x, y, z).squared_cosine(part.direction));
             const double found = worth * slant * area;
             const Eigen::Vector3i lattice = field.grid().first + Eigen::Vector3i(x, y, z), cell = lattice - grid.first;
             const Voxel& voxel = voxels.at(cell.x(), cell.y(), cell.z());
             part.voxels.push_back({{std::int16_t(lattice.x()), std::int16_t(lattice.y()), std::int16_t(lattice.z())},
                                    voxel.measured,
                                    voxel.probability,
                                    reach,
                                    found});
             part.contribution += found;
           });
  });
  for (std::size_t begin = 0; begin < explanation.rays.size(); begin += rays_a_part) {
    double area = 0.0;
    for (std::size_t i = begin; i < std::min(begin + rays_a_part, explanation.rays.size()); ++i)
      for (const ScoreExplanation::Voxel& voxel : explanation.rays[i].voxels) area += voxel.contribution;
    explanation.value += area;
  }
  return explanation;
}

}  // namespace nextview
