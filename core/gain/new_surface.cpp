#include "core/gain/new_surface.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/map/traversal.hpp"

namespace nextview {
namespace {

constexpr double square_centimetres = 1e4;  // in a square metre
constexpr double negligible = 1e-3;         // reach at which a ray is given up

/// Calls `visit(x, y, z, reach, found)` for the voxels of the field on a ray: how likely it gets there, and how likely
/// it finds new surface there.
template <class Visit>
void follow(const NewSurfaceField& field, const Vector3& origin, const Vector3& direction, double length, Visit visit) {
  const VoxelGrid& grid = field.grid();
  const std::size_t row = grid.size.x(), layer = row * grid.size.y();
  double reach = 1.0;
  walk_ray_segments(grid, origin, direction, length, [&](int x, int y, int z, double enter, double exit) {
    const float chance = field.at(z * layer + y * row + x);
    if (chance == 0.0f) return true;
    const double found = reach * std::abs(chance), range = 0.5 * (enter + exit);
    visit(x, y, z, reach, found * range * range);
    reach -= found;
    return chance > 0.0f && reach > negligible;
  });
}

}  // namespace

NewSurfaceField::NewSurfaceField(const SurfaceEvidence& evidence, const NewSurfaceModel& model)
    : grid_(evidence.grid()), chances_(grid_.voxel_count()) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chances_.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) chances_[i] = model.chance(evidence, i);
  });
}

namespace {

/// The new surface that one view is expected to see [cm^2]. `visit(x, y, z, area)` gets the area across a ray [m^2].
template <class Visit>
double area_of_view(const NewSurfaceField& field, const Pose& view, const RayBundle& bundle,
                    const NewSurfaceOptions& options, Visit visit) {
  double area = 0.0;
  for (std::size_t i = 0; i < bundle.directions.size(); ++i) {
    double of_ray = 0.0;
    follow(field, view.translation(), view.linear() * bundle.directions[i], options.ray_length,
           [&](int x, int y, int z, double, double found) {
             of_ray += found;
             visit(x, y, z, found * bundle.solid_angles[i]);
           });
    area += of_ray * bundle.solid_angles[i];
  }
  return square_centimetres * options.slant * area;
}

}  // namespace

std::vector<double> expected_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                         const RayBundle& bundle, const NewSurfaceOptions& options,
                                         std::stop_token stop) {
  std::vector<double> areas(views.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (!stop.stop_requested()) areas[v] = area_of_view(field, views[v], bundle, options, [](int, int, int, double) {});
  });
  return areas;
}

NewSurfaceForecast forecast_new_surface(const NewSurfaceField& field, std::span<const Pose> views,
                                        const RayBundle& bundle, const NewSurfaceOptions& options,
                                        std::stop_token stop) {
  const Eigen::Vector3i parts = (field.grid().size + Eigen::Vector3i::Constant(7)) / 8;
  NewSurfaceForecast forecast;
  forecast.part_count = static_cast<std::size_t>(parts.prod());
  forecast.areas.assign(views.size(), 0.0);
  forecast.parts.assign(views.size(), std::vector<float>(forecast.part_count, 0.0f));
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t v) {
    if (stop.stop_requested()) return;
    const double worth = square_centimetres * options.slant;
    forecast.areas[v] = area_of_view(field, views[v], bundle, options, [&](int x, int y, int z, double area) {
      forecast.parts[v][std::size_t(((z >> 3) * parts.y() + (y >> 3)) * parts.x() + (x >> 3))] += float(worth * area);
    });
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
