#include "core/offline/training_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random/counter_random.hpp"
#include "core/surface/isosurface.hpp"

namespace nextview {
namespace {

enum class Shape { box, cylinder, ball, ring };

struct Solid {
  Shape shape = Shape::box;
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d R_world_solid = Eigen::Matrix3d::Identity();
  /// Half edges of a box; radius, -, half height of a cylinder; radius of a ball; radius and thickness of a ring [m].
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
    bodies();
    const auto features = [&](double most, auto make) {
      for (int i = static_cast<int>(between(0, most)); i > 0; --i)
        make(body(static_cast<int>(between(0, body_count_))));
    };
    features(6, [&](const Solid& body) { added_.push_back(rib(body)); });
    features(8, [&](const Solid& body) { removed_.push_back(cut(body)); });
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

  void bodies() {
    body_count_ = 1 + static_cast<int>(between(0, 3.5));
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

  CounterRandom random_;
  std::uint64_t drawn_ = 0;
  int body_count_ = 0;
  std::vector<Solid> added_, removed_;
};

}  // namespace

TriangleMesh training_part(std::uint32_t number, std::uint64_t seed) {
  constexpr int points = 120;
  constexpr double edge = 1.6;
  Designer designer(number, seed);
  designer.design();
  ScalarField field{Eigen::Vector3i::Constant(points), Vector3::Constant(-edge / 2), edge / (points - 1), {}};
  field.values.reserve(field.point_count());
  for (int z = 0; z < points; ++z)
    for (int y = 0; y < points; ++y)
      for (int x = 0; x < points; ++x) {
        const Eigen::Vector3i point(x, y, z);
        const bool outermost = point.minCoeff() == 0 || point.maxCoeff() == points - 1;
        const double distance = designer.distance(field.origin + field.spacing * point.cast<double>());
        // Never the level itself, and closed at the lattice's border.
        field.values.push_back(static_cast<float>(-(outermost ? std::max(distance, field.spacing) : distance) + 1e-7));
      }
  TriangleMesh mesh = isosurface(field, 0.0f);
  const auto box = mesh.bounding_box();
  const double scale = 0.5 / box.sizes().maxCoeff();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex = ((vertex.cast<double>() - box.center()) * scale).cast<float>();
  return mesh;
}

}  // namespace nextview
