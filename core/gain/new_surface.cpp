#include "core/gain/new_surface.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/map/traversal.hpp"

namespace nextview {
namespace {

constexpr double square_centimetres = 1e4;  // in a square metre
constexpr double negligible = 1e-3;         // reach at which a ray is given up

/// Calls `visit(x, y, z, reach, found)` for the voxels of the field on a ray: how likely it gets there, and how likely
/// it finds new surface there. What find_along_rays does for many rays at once, as it is meant to be read.
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
    : grid_(evidence.grid()), chances_(places_with_margin(grid_)) {
  fill_margin(grid_, chances_, ChanceField::outside);
  const BitRows& blocks = evidence.unmeasured_blocks();
  const int edge = evidence.block_edge();
  // A layer of blocks each.
  tbb::parallel_for(0, blocks.size().z(), [&](int block_z) {
    std::vector<float> in_blocks(std::size_t(blocks.size().x()));
    for (int block_y = 0; block_y < blocks.size().y(); ++block_y) {
      blocks.for_each_in_row(block_y, block_z, [&](int x) {
        in_blocks[std::size_t(x)] = model.chance_in_block(evidence, {x, block_y, block_z});
      });
      for (int z = edge * block_z; z < std::min(edge * (block_z + 1), grid_.size.z()); ++z)
        for (int y = edge * block_y; y < std::min(edge * (block_y + 1), grid_.size.y()); ++y) {
          float* const row = &chances_[place_with_margin(grid_, 0, y, z)];
          std::fill_n(row, grid_.size.x(), 0.0f);
          evidence.all_that_may_hold_surface().for_each_in_row(y, z, [&](int x) {
            row[x] = evidence.kind({x, y, z}) == SurfaceEvidence::Kind::unmeasured ? in_blocks[std::size_t(x / edge)]
                                                                                   : model.chance(evidence, {x, y, z});
          });
        }
    }
  });
}

namespace {

/// The new surface that one view is expected to see [cm^2], and where, if `finds` is not null.
double area_of_view(const NewSurfaceField& field, const Pose& view, const RayBundle& bundle,
                    const NewSurfaceOptions& options, Finds* finds) {
  std::vector<Vector3> directions;
  for (const Vector3& direction : bundle.directions) directions.emplace_back(view.linear() * direction);
  std::vector<double> of_rays(directions.size());
  find_along_rays({field.grid(), view.translation(), directions, options.ray_length}, {field.chances(), negligible},
                  of_rays, finds);
  double area = 0.0;
  for (std::size_t i = 0; i < of_rays.size(); ++i) area += of_rays[i] * bundle.solid_angles[i];
  return square_centimetres * options.slant * area;
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
    const std::uint32_t x = place % row_ - 1, y = place % layer_ / row_ - 1, z = place / layer_ - 1;
    return (std::size_t(z >> 3) * std::size_t(parts_.y()) + (y >> 3)) * std::size_t(parts_.x()) + (x >> 3);
  }

 private:
  std::uint32_t row_, layer_;
  Eigen::Vector3i parts_;  ///< along each axis
};

/// Adds up, ray by ray, how much of a view's new surface lies in each part.
void add_to_parts(const Finds& finds, const RayBundle& bundle, double worth, const Parts& parts,
                  std::vector<float>& areas) {
  for (std::size_t ray = 0; ray < finds.begins.size(); ++ray)
    for (std::size_t i = finds.begins[ray]; i < finds.ends[ray]; ++i)
      areas[parts.of(finds.finds[i].place)] += float(worth * (finds.finds[i].area * bundle.solid_angles[ray]));
}

}  // namespace

std::vector<double> expected_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                         const RayBundle& bundle, const NewSurfaceOptions& options,
                                         std::stop_token stop) {
  std::vector<double> areas(views.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!stop.stop_requested()) areas[v] = area_of_view(field, views[v], bundle, options, nullptr);
  });
  return areas;
}

NewSurfaceForecast forecast_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                        const RayBundle& bundle, const NewSurfaceOptions& options,
                                        std::stop_token stop) {
  const Parts parts(field.grid());
  NewSurfaceForecast forecast;
  forecast.part_count = parts.count();
  forecast.areas.assign(views.size(), 0.0);
  forecast.parts.assign(views.size(), std::vector<float>(forecast.part_count, 0.0f));
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (stop.stop_requested()) return;
    Finds finds;
    forecast.areas[v] = area_of_view(field, views[v], bundle, options, &finds);
    add_to_parts(finds, bundle, square_centimetres * options.slant, parts, forecast.parts[v]);
  });
  for (std::size_t part = 0; part < forecast.part_count; ++part) {
    float most = 0.0f;
    for (const std::vector<float>& of_view : forecast.parts) most = std::max(most, of_view[part]);
    forecast.all += most;
  }
  return forecast;
}

ScoreExplanation explain_new_surface(const NewSurfaceField& field, const VoxelGrid& grid, const VoxelBricks& voxels,
                                     const Pose& T_world_camera, const RayBundle& bundle,
                                     const NewSurfaceOptions& options) {
  ScoreExplanation explanation;
  double area = 0.0;  // added up as for the score, to round alike
  for (std::size_t i = 0; i < bundle.directions.size(); ++i) {
    ScoreExplanation::RayPart& part = explanation.rays.emplace_back();
    part.direction = T_world_camera.linear() * bundle.directions[i];
    const double worth = square_centimetres * options.slant * bundle.solid_angles[i];
    double of_ray = 0.0;
    follow(field, T_world_camera.translation(), part.direction, options.ray_length,
           [&](int x, int y, int z, double reach, double found) {
             const Eigen::Vector3i lattice = field.grid().first + Eigen::Vector3i(x, y, z), cell = lattice - grid.first;
             const Voxel& voxel = voxels.at(cell.x(), cell.y(), cell.z());
             part.voxels.push_back({{std::int16_t(lattice.x()), std::int16_t(lattice.y()), std::int16_t(lattice.z())},
                                    voxel.measured,
                                    voxel.probability,
                                    reach,
                                    worth * found});
             part.contribution += worth * found;
             of_ray += found;
           });
    area += of_ray * bundle.solid_angles[i];
  }
  explanation.value = square_centimetres * options.slant * area;
  return explanation;
}

}  // namespace nextview
