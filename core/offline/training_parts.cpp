#include "core/offline/training_parts.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random/counter_random.hpp"
#include "core/surface/isosurface.hpp"

namespace nextview {
namespace {

enum class Shape { box, cylinder, tube, ball, ring };

struct Solid {
  Shape shape = Shape::box;
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d R_world_solid = Eigen::Matrix3d::Identity();
  /// Half edges of a box; radius, -, half height of a cylinder; radius, half thickness and half height of a tube;
  /// radius of a ball; radius and thickness of a ring [m].
  Vector3 half = Vector3::Zero();

  /// Negative inside [m].
  double distance(const Vector3& point) const {
    const Vector3 p = R_world_solid.transpose() * (point - centre);
    const double across = std::hypot(p.x(), p.y());
    switch (shape) {
      case Shape::box: {
        const Vector3 beyond = p.cwiseAbs() - half;
        return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
      }
      case Shape::cylinder: {
        const double side = across - half.x(), end = std::abs(p.z()) - half.z();
        return std::min(std::max(side, end), 0.0) + std::hypot(std::max(side, 0.0), std::max(end, 0.0));
      }
      case Shape::tube:
        return std::max(std::abs(across - half.x()) - half.y(), std::abs(p.z()) - half.z());
      case Shape::ball:
        return p.norm() - half.x();
      case Shape::ring:
        return std::hypot(across - half.x(), p.z()) - half.y();
    }
    return 0.0;
  }
};

class Designer {
 public:
  Designer(std::uint32_t number, std::uint64_t seed) : random_(seed, random_stream::training_parts, number) {}

  void design() {
    bodies(3.5);
    features(6, [&](const Solid& body) { added_.push_back(rib(body)); });
    features(8, [&](const Solid& body) { removed_.push_back(cut(body)); });
  }

  /// Fewer and smaller bodies, and on them rings and rows of the same small thing, thin walls and narrow grooves.
  void design_in_detail() {
    bodies(2.5);
    features(2, [&](const Solid& body) { added_.push_back(rib(body)); });
    features(3, [&](const Solid& body) { removed_.push_back(cut(body)); });
    for (int i = 3 + static_cast<int>(between(0, 6)); i > 0; --i) {
      const Solid of = body(static_cast<int>(between(0, body_count_)));
      happens(0.35) ? wall_or_groove(of) : repeat(small_thing(), of);
    }
  }

  /// Moves the middle into the origin, and makes it smaller; walls to multiples of half of `raster` then, if it is not
  /// 0.
  void place(const Vector3& middle, double scale, double raster) {
    for (std::vector<Solid>* solids : {&added_, &removed_})
      for (Solid& solid : *solids) {
        solid.centre = (solid.centre - middle) * scale;
        solid.half *= scale;
        if (raster == 0.0 || solid.shape == Shape::ball || solid.shape == Shape::ring) continue;
        const double step = raster / 2;
        const auto rounded = [&](double v) { return std::round(v / step) * step; };
        solid.centre = solid.centre.unaryExpr(rounded);
        if (solid.shape != Shape::tube) solid.half = solid.half.unaryExpr(rounded).cwiseMax(step);
      }
  }

  double distance(const Vector3& point) const {
    double distance = std::numeric_limits<double>::max();
    for (const Solid& solid : added_) distance = std::min(distance, solid.distance(point));
    for (const Solid& solid : removed_) distance = std::max(distance, -solid.distance(point));
    return distance;
  }

 private:
  double between(double low, double high) { return low + (high - low) * random_.uniform(drawn_++)[0]; }
  bool happens(double probability) { return between(0, 1) < probability; }
  Vector3 between(const Vector3& low, const Vector3& high) {
    const double x = between(low.x(), high.x()), y = between(low.y(), high.y());
    return {x, y, between(low.z(), high.z())};
  }
  template <class Make>
  void features(double most, Make make) {
    for (int i = static_cast<int>(between(0, most)); i > 0; --i) make(body(static_cast<int>(between(0, body_count_))));
  }
  const Solid& body(int i) const { return added_[static_cast<std::size_t>(i)]; }

  /// Along an axis, or, if it happens so, in any direction.
  Eigen::Matrix3d turned(double probability_of_any) {
    using Turn = Eigen::AngleAxisd;
    if (happens(probability_of_any)) {
      const Vector3 axis = between(Vector3::Constant(-1), Vector3::Constant(1)) + Vector3(0, 0, 1e-9);
      return Turn(between(0, std::numbers::pi), axis.normalized()).toRotationMatrix();
    }
    const int axis = static_cast<int>(between(0, 3));
    if (axis == 0) return Eigen::Matrix3d::Identity();
    return Turn(std::numbers::pi / 2, axis == 1 ? Vector3::UnitX() : Vector3::UnitY()).toRotationMatrix();
  }
  Vector3 somewhere_on(const Solid& solid) {
    const Vector3 where = between(Vector3::Constant(-1), Vector3::Constant(1));
    return solid.centre + solid.R_world_solid * where.cwiseProduct(solid.half);
  }

  void bodies(double most) {
    body_count_ = 1 + static_cast<int>(between(0, most));
    Vector3 centre = Vector3::Zero();
    for (int i = 0; i < body_count_; ++i) {
      const double which = between(0, 1);
      const Shape shape = which < 0.55   ? Shape::box
                          : which < 0.85 ? Shape::cylinder
                          : which < 0.93 ? Shape::ball
                                         : Shape::ring;
      Solid solid{shape, centre, turned(0.2), between({0.03, 0.03, 0.02}, {0.25, 0.25, 0.25})};
      if (shape == Shape::ball) solid.half = Vector3::Constant(between(0.06, 0.2));
      if (shape == Shape::ring) solid.half = {between(0.1, 0.2), between(0.02, 0.06), 0.02};
      added_.push_back(solid);
      centre = somewhere_on(solid);
    }
  }
  Solid rib(const Solid& body) {
    const Shape shape = happens(0.6) ? Shape::box : Shape::cylinder;
    const Eigen::Matrix3d turn = turned(0.15);
    const Vector3 half = between({0.01, 0.01, 0.01}, {0.06, 0.12, 0.15});
    return {shape, somewhere_on(body), turn, half};
  }
  Solid cut(const Solid& body) {
    const Shape shape = happens(0.45) ? Shape::box : Shape::cylinder;
    const Eigen::Matrix3d turn = turned(0.15);
    const Vector3 half = happens(0.4) ? between({0.04, 0.04, 0.03}, {0.15, 0.15, 0.2})   // a pocket
                                      : between({0.01, 0.01, 0.05}, {0.04, 0.06, 0.3});  // a slot or a bore
    return {shape, somewhere_on(body), turn, half};
  }

  Solid small_thing() {
    const double which = between(0, 1);
    const Shape shape = which < 0.35 ? Shape::ball : which < 0.65 ? Shape::cylinder : Shape::box;
    Solid solid{shape, Vector3::Zero(), turned(0.1), between({0.006, 0.006, 0.01}, {0.04, 0.04, 0.1})};
    if (shape == Shape::ball) solid.half = Vector3::Constant(between(0.012, 0.06));
    return solid;
  }
  /// The middle of one of its two ends.
  Vector3 end_of(const Solid& body) {
    const double half = body.shape == Shape::ring ? body.half.y() : body.half.z();
    return body.centre + (happens(0.5) ? half : -half) * body.R_world_solid.col(2);
  }
  static double radius_of(const Solid& body) {
    return body.shape == Shape::box ? std::min(body.half.x(), body.half.y()) : body.half.x();
  }
  void wall_or_groove(const Solid& body) {
    const double radius = between(0.3, 1.1) * radius_of(body), thickness = between(0.003, 0.012);
    (happens(0.4) ? added_ : removed_)
        .push_back({Shape::tube, end_of(body), body.R_world_solid, {radius, thickness, between(0.02, 0.15)}});
  }
  /// Around the body's axis, at an end of it, or in a row.
  void repeat(Solid solid, const Solid& body) {
    std::vector<Solid>& to = happens(0.6) ? added_ : removed_;
    const int count = 3 + static_cast<int>(between(0, 14));
    const bool in_a_ring = happens(0.65);
    const double radius = between(0.4, 1.1) * radius_of(body);
    const Vector3 end = end_of(body), begin = somewhere_on(body);
    const double pitch = between(0.015, 0.07);
    const Vector3 step = pitch * body.R_world_solid.col(static_cast<int>(between(0, 3)));
    const Eigen::Matrix3d R = solid.R_world_solid;
    for (int i = 0; i < count; ++i) {
      const Eigen::AngleAxisd turn(2 * std::numbers::pi * i / count, Vector3::UnitZ());
      solid.centre = begin + (i - (count - 1) / 2.0) * step;
      if (in_a_ring) solid.centre = end + body.R_world_solid * (turn * Vector3(radius, 0, 0));
      if (in_a_ring) solid.R_world_solid = body.R_world_solid * turn.toRotationMatrix() * R;
      to.push_back(solid);
    }
  }

  CounterRandom random_;
  std::uint64_t drawn_ = 0;
  int body_count_ = 0;
  std::vector<Solid> added_, removed_;
};

/// `points` along each axis of a cube of that edge around the origin.
TriangleMesh surface_of(const Designer& designer, int points, double edge) {
  ScalarField field{Eigen::Vector3i::Constant(points), Vector3::Constant(-edge / 2), edge / (points - 1), {}};
  field.values.resize(field.point_count());
  const auto set = [&](const Eigen::Vector3i& point, double distance) {
    const bool outermost = point.minCoeff() == 0 || point.maxCoeff() == points - 1;
    // Never the level itself, and closed at the lattice's border.
    field.values[field.index(point)] =
        static_cast<float>(-(outermost ? std::max(distance, field.spacing) : distance) + 1e-7);
  };
  tbb::parallel_for(0, points, [&](int z) {
    for (int y = 0; y < points; ++y)
      for (int x = 0; x < points; ++x) {
        const Eigen::Vector3i point(x, y, z);
        const double distance = designer.distance(field.origin + field.spacing * point.cast<double>());
        set(point, distance);
        // Far from the surface the next points are on the same side, and how far they are does not matter.
        for (int far = static_cast<int>(std::abs(distance) / field.spacing) - 2; far > 0 && x + 1 < points; --far)
          set({++x, y, z}, distance);
      }
  });
  return isosurface(field, 0.0f);
}

}  // namespace

TriangleMesh training_part(std::uint32_t number, std::uint64_t seed) {
  Designer designer(number, seed);
  designer.design();
  TriangleMesh mesh = surface_of(designer, 120, 1.6);
  const auto box = mesh.bounding_box();
  const double scale = 0.5 / box.sizes().maxCoeff();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex = ((vertex.cast<double>() - box.center()) * scale).cast<float>();
  return mesh;
}

TriangleMesh detailed_training_part(std::uint32_t number, std::uint64_t seed) {
  Designer designer(number, seed);
  designer.design_in_detail();
  const auto box = surface_of(designer, 120, 1.6).bounding_box();
  designer.place(box.center().cast<double>(), 0.5 / box.sizes().maxCoeff(), number % 4 < 2 ? 0.01 : 0.0);
  return surface_of(designer, 221, 0.55);
}

}  // namespace nextview
