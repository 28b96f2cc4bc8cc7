#include "core/gain/drawn_worlds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/map/traversal.hpp"
#include "core/progress/stopped.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

using Kind = SurfaceEvidence::Kind;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double patch = 0.12;  // over which drawn surfaces are alike, as a share of the object's size

/// The voxels of a grid, and which lie beside each other.
struct Lattice {
  explicit Lattice(const VoxelGrid& grid) : size(grid.size), strides(1, size.x(), size.x() * size.y()) {}

  /// Calls `visit(i, cell)` for all of them, or for all backwards.
  template <class Visit>
  void each(bool backwards, Visit visit) const {
    const auto along = [&](int k, int axis) { return backwards ? size[axis] - 1 - k : k; };
    int i = backwards ? size.prod() - 1 : 0;
    for (int z = 0; z < size.z(); ++z)
      for (int y = 0; y < size.y(); ++y)
        for (int x = 0; x < size.x(); ++x) {
          visit(i, Eigen::Vector3i(along(x, 0), along(y, 1), along(z, 2)));
          i += backwards ? -1 : 1;
        }
  }
  bool is_at_rim(const Eigen::Vector3i& cell) const {
    return (cell.array() == 0).any() || (cell.array() == size.array() - 1).any();
  }

  Eigen::Vector3i size, strides;
};

/// Of each unmeasured voxel the least that a way from what is free, face by face, adds up to of -ln(1 - q); infinite
/// where it would lead through occupied voxels.
std::vector<float> depths(const SurfaceEvidence& evidence, const NewSurfaceField& field) {
  const Lattice lattice(field.grid());
  std::vector<float> depth(field.grid().voxel_count()), more(depth.size(), 0.0f);
  lattice.each(false, [&](int i, const Eigen::Vector3i& cell) {
    const Kind kind = evidence.kind(cell);
    depth[i] = kind == Kind::free ? 0.0f : infinity;
    if (kind != Kind::unmeasured) return;
    more[i] = -std::log1p(-std::min(field.at(cell.x(), cell.y(), cell.z()), 0.999f));
    if (lattice.is_at_rim(cell)) depth[i] = more[i];
  });
  for (int sweep = 0; sweep < 4; ++sweep) {  // ways with few turns back
    const int step = sweep % 2 == 0 ? -1 : 1;
    lattice.each(sweep % 2 == 1, [&](int i, const Eigen::Vector3i& cell) {
      if (evidence.kind(cell) != Kind::unmeasured) return;
      for (int axis = 0; axis < 3; ++axis)
        if (unsigned(cell[axis] + step) < unsigned(lattice.size[axis]))
          depth[i] = std::min(depth[i], depth[i + step * lattice.strides[axis]] + more[i]);
    });
  }
  return depth;
}

/// The normal quantile of the chance that a solid begins above a depth.
class DepthQuantile {
 public:
  DepthQuantile() {
    for (std::size_t k = 0; k < depths_.size(); ++k)
      depths_[k] = static_cast<float>(-std::log(0.5 * std::erfc(at(k) / std::numbers::sqrt2)));
  }
  float operator()(float depth) const {
    const auto above = std::upper_bound(depths_.begin(), depths_.end(), depth);
    return above == depths_.end() ? infinity : static_cast<float>(at(std::size_t(above - depths_.begin())));
  }

 private:
  static double at(std::size_t k) { return -5.0 + 10.0 * double(k) / 511.0; }
  std::array<float, 512> depths_{};
};

/// Draws what blocks rays: voxels whose limit is at least a smooth random field.
class Solids {
 public:
  Solids(const SurfaceEvidence& evidence, const NewSurfaceField& field, const CounterRandom& random)
      : lattice_(field.grid()), random_(random), limits_(depths(evidence, field)) {
    spacing_ = std::max(2, static_cast<int>(std::lround(patch * evidence.size())));
    knots_ = (lattice_.size.array() / spacing_ + 2).matrix();
    const DepthQuantile quantile;
    const auto spread = [&](int at) { return std::hypot(part(at), 1.0f - part(at)); };
    lattice_.each(false, [&](int i, const Eigen::Vector3i& cell) {
      if (evidence.kind(cell) == Kind::free) limits_[i] = -infinity;
      if (evidence.kind(cell) == Kind::unmeasured)
        limits_[i] = quantile(limits_[i]) * spread(cell.x()) * spread(cell.y()) * spread(cell.z());
    });
  }

  std::vector<std::uint8_t> draw(std::uint64_t world) const {
    std::vector<float> knots(static_cast<std::size_t>(knots_.prod()));
    for (std::size_t k = 0; k < knots.size(); ++k)
      knots[k] = static_cast<float>(random_.normal((world << 32) + std::uint64_t(k))[0]);
    std::vector<std::uint8_t> blocks(limits_.size());
    std::vector<float> row(static_cast<std::size_t>(knots_.x()));
    std::size_t i = 0;
    for (int z = 0; z < lattice_.size.z(); ++z)
      for (int y = 0; y < lattice_.size.y(); ++y) {
        for (int k = 0; k < knots_.x(); ++k) row[k] = between_knots(knots, k, y, z);
        for (int x = 0; x < lattice_.size.x(); ++x, ++i)
          blocks[i] = between(row[x / spacing_], row[x / spacing_ + 1], part(x)) <= limits_[i];
      }
    return blocks;
  }

 private:
  static float between(float a, float b, float part) { return a + part * (b - a); }
  float part(int at) const { return float(at % spacing_) / float(spacing_); }
  float between_knots(const std::vector<float>& knots, int x, int y, int z) const {
    const auto along_y = [&](int layer) {
      const std::size_t row = std::size_t(layer) * std::size_t(knots_.y()) + std::size_t(y / spacing_);
      const auto at = &knots[row * std::size_t(knots_.x()) + std::size_t(x)];
      return between(*at, at[knots_.x()], part(y));
    };
    return between(along_y(z / spacing_), along_y(z / spacing_ + 1), part(z));
  }

  Lattice lattice_;
  CounterRandom random_;
  int spacing_;
  Eigen::Vector3i knots_;
  std::vector<float> limits_;
};

/// How much of the surface that is not covered yet each voxel has, as a share of its face.
std::vector<float> new_surface(const SurfaceEvidence& evidence, const NewSurfaceField& field,
                               const std::vector<std::uint8_t>& blocks) {
  const Lattice lattice(field.grid());
  std::vector<float> shares(blocks.size(), 0.0f);
  lattice.each(false, [&](int i, const Eigen::Vector3i& cell) {
    const float chance = field.at(cell.x(), cell.y(), cell.z());
    if (!blocks[i]) {
      if (evidence.kind(cell) == Kind::free) shares[i] = chance;
      return;
    }
    bool is_bare = lattice.is_at_rim(cell);
    for (int axis = 0; axis < 3 && !is_bare; ++axis)
      is_bare = !blocks[i - lattice.strides[axis]] || !blocks[i + lattice.strides[axis]];
    if (is_bare) shares[i] = evidence.kind(cell) == Kind::occupied ? -chance : 1.0f;
  });
  return shares;
}

/// A view's camera, as far as its rays tell.
class Frustum {
 public:
  Frustum(const RayBundle& bundle, double range) : range_(range) {
    for (const Vector3& d : bundle.directions) reach_ = reach_.cwiseMax((d.head<2>() / d.z()).cwiseAbs());
  }
  bool holds(const Vector3& in_camera) const {
    return in_camera.z() > 0.0 && in_camera.norm() <= range_ &&
           (in_camera.head<2>().cwiseAbs().array() <= reach_.array() * in_camera.z()).all();
  }

 private:
  double range_;
  Eigen::Vector2d reach_ = Eigen::Vector2d::Zero();
};

/// Whether nothing blocks the way from a voxel's middle to `eye`. What is right beside it does not count: surfaces have
/// steps in a lattice.
bool is_open(const VoxelGrid& grid, const std::vector<std::uint8_t>& blocks, const Vector3& from, const Vector3& eye) {
  const double beside = 1.5 * grid.resolution, distance = (eye - from).norm();
  bool open = true;
  walk_ray_segments(grid, from, (eye - from) / distance, distance, [&](int x, int y, int z, double enter, double) {
    return open = enter < beside || !blocks[grid.index({x, y, z})];
  });
  return open;
}

DrawnWorld seen_world(const VoxelGrid& grid, const std::vector<std::uint8_t>& blocks, const std::vector<float>& surface,
                      std::span<const Pose> views, const Frustum& frustum) {
  double whole = 0.0;
  for (const float share : surface) whole += share;
  DrawnWorld world;
  world.seen.resize(views.size());
  const double spacing = whole / double(DrawnWorld::samples);
  world.area = square_centimetres_of_a_square_metre * spacing * grid.resolution * grid.resolution;
  double so_far = 0.0;
  std::size_t sample = 0;
  for (std::uint32_t i = 0; i < surface.size(); ++i) {
    so_far += surface[i];
    for (; sample < DrawnWorld::samples && so_far > (double(sample) + 0.5) * spacing; ++sample) {
      const Vector3 at = grid.centre(i);
      for (std::size_t v = 0; v < views.size(); ++v)
        world.seen[v][sample] =
            frustum.holds(views[v].inverse(Eigen::Isometry) * at) && is_open(grid, blocks, at, views[v].translation());
    }
  }
  return world;
}

}  // namespace

std::vector<DrawnWorld> draw_worlds(const SurfaceEvidence& evidence, const NewSurfaceField& field,
                                    std::span<const Pose> views, const RayBundle& bundle, const WorldDraws& draws,
                                    std::stop_token stop) {
  std::vector<DrawnWorld> worlds(field.grid().voxel_count() > 0 ? std::size_t(draws.count) : 0);
  const Solids solids(evidence, field, CounterRandom(draws.seed, random_stream::drawn_worlds, draws.step));
  const Frustum frustum(bundle, draws.ray_length);
  tbb::parallel_for(std::size_t{0}, worlds.size(), [&](std::size_t w) {
    if (stop.stop_requested()) return;
    const std::vector<std::uint8_t> blocks = solids.draw(w);
    worlds[w] = seen_world(field.grid(), blocks, new_surface(evidence, field, blocks), views, frustum);
  });
  throw_if_stopped(stop);
  return worlds;
}

}  // namespace nextview
