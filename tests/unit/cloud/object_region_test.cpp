#include "core/cloud/object_region.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {
namespace {

using Vector3f = Eigen::Vector3f;

/// A quadrilateral, from three of its corners [m].
void add_sheet(TriangleMesh& mesh, const Vector3f& corner, const Vector3f& along, const Vector3f& across) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Vector3f& p :
       {corner, Vector3f(corner + along), Vector3f(corner + along + across), Vector3f(corner + across)})
    mesh.vertices.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

TriangleMesh& add_box(TriangleMesh& mesh, const Vector3f& low, const Vector3f& high) {
  const Vector3f size = high - low, x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  for (const Vector3f& corner : {low, Vector3f(low + z)}) add_sheet(mesh, corner, x, y);
  for (const Vector3f& corner : {low, Vector3f(low + y)}) add_sheet(mesh, corner, x, z);
  for (const Vector3f& corner : {low, Vector3f(low + x)}) add_sheet(mesh, corner, y, z);
  return mesh;
}

void add_cylinder(TriangleMesh& mesh, float radius, float height) {
  constexpr int sides = 48;
  const auto at = [&](int k, float z) {
    const float angle = 2.0f * std::numbers::pi_v<float> * float(k) / sides;
    return Vector3f(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int k = 0; k < sides; ++k) {
    add_sheet(mesh, at(k, 0), at(k + 1, 0) - at(k, 0), Vector3f(0, 0, height));
    add_sheet(mesh, Vector3f(0, 0, height), at(k, height) - Vector3f(0, 0, height), at(k + 1, 0) - at(k, 0));
  }
}

void add_part(TriangleMesh& mesh) {
  const TriangleMesh part = load_mesh(NEXTVIEW_SOURCE_DIR "/assets/objects/slotted_housing.ply");
  const float bottom = part.bounding_box().min().z();
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Vector3f& v : part.vertices) mesh.vertices.push_back(v - Vector3f(0, 0, bottom));
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

void add_table(TriangleMesh& mesh, float half = 0.6f) {
  add_sheet(mesh, {-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0});
}

/// What a camera with noise of 2 mm sees of it from some sides.
std::vector<std::shared_ptr<const Scan>> seen(const TriangleMesh& mesh, int views = 3, double turn = 0.6,
                                              int width = 320) {
  DepthCameraConfig sensor;
  sensor.width = width;
  sensor.height = 3 * width / 4;
  sensor.max_range = 3.0;
  const DepthCamera camera(sensor);
  const MeshRayCaster scene(mesh);
  std::vector<std::shared_ptr<const Scan>> scans;
  for (int k = 0; k < views; ++k) {
    const double angle = turn * (k - 1);
    const Pose pose = look_at({1.0 * std::cos(angle), 1.0 * std::sin(angle), 0.7}, {0, 0, 0.1});
    const DepthImage image = camera.sense(scene, pose, 1, std::uint32_t(k));
    Scan scan = back_project(image, pose, sensor.max_range);
    scan.hits = clean(scan.hits, {});
    scans.push_back(std::make_shared<const Scan>(std::move(scan)));
  }
  return scans;
}

struct Case {
  std::string name;
  std::function<void(TriangleMesh&)> add;
  Eigen::AlignedBox3d box;
};
std::vector<Case> cases() {
  return {{"box",
           [](TriangleMesh& mesh) {
             add_box(mesh, {-0.12f, -0.15f, 0}, {0.12f, 0.15f, 0.2f});
           },
           {Vector3(-0.12, -0.15, 0), Vector3(0.12, 0.15, 0.2)}},
          {"cylinder",
           [](TriangleMesh& mesh) { add_cylinder(mesh, 0.12f, 0.25f); },
           {Vector3(-0.12, -0.12, 0), Vector3(0.12, 0.12, 0.25)}},
          {"slotted part", add_part, {Vector3(-0.25, -0.19, 0), Vector3(0.25, 0.19, 0.38)}}};
}

TEST(ObjectRegion, IsWhatStandsOnTheTable) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    TriangleMesh mesh;
    c.add(mesh);
    add_table(mesh);
    const ObjectRegion region = find_object(seen(mesh));
    ASSERT_EQ(region.planes.size(), 1u) << region.text();
    EXPECT_GT(region.planes[0].normal.z(), 0.999);
    EXPECT_NEAR(region.planes[0].offset, 0.0, 0.003);
    std::cout << c.name << ": " << region.text() << "\n";
    const Eigen::AlignedBox3d visible = c.box;
    Eigen::AlignedBox3d kept;
    for (const Vector3f& p : region.points) kept.extend(p.cast<double>());
    EXPECT_LT((kept.max() - visible.max()).maxCoeff(), 0.02);
    EXPECT_LT((visible.min() - kept.min()).maxCoeff(), 0.02);
  }
}

TEST(ObjectRegion, KeepsThePartsOwnFaces) {
  for (const Case& c : cases())
    for (const int views : {1, 3}) {
      SCOPED_TRACE(c.name);
      TriangleMesh mesh;
      c.add(mesh);
      const auto scans = seen(mesh, views);
      const ObjectRegion region = find_object(scans);
      EXPECT_TRUE(region.planes.empty()) << region.text();
      std::size_t points = 0;
      for (const auto& scan : scans) points += scan->hits.size();
      EXPECT_GT(double(region.points.size()), 0.9 * double(points)) << region.text();
    }
}

TEST(ObjectRegion, HoldsWhatASingleViewDoesNotShow) {
  for (const Case& c : cases())
    for (const bool on_table : {true, false})
      for (const int width : {320, 64}) {
        SCOPED_TRACE(fmt::format("{}, {}, {} pixels", c.name, on_table ? "on a table" : "in the air", width));
        TriangleMesh mesh;
        c.add(mesh);
        if (on_table) add_table(mesh);
        const ObjectRegion region = find_object(seen(mesh, 1, 0.6, width));
        EXPECT_TRUE(region.box.contains(c.box)) << region.box.min().transpose() << ", " << region.box.max().transpose();
        EXPECT_LT(region.box.sizes().maxCoeff(), 2.2 * c.box.sizes().maxCoeff());
        EXPECT_GT(region.box.min().z(), on_table ? -0.15 : -0.5) << "what it stands on has nothing behind it";
      }
}

TEST(ObjectRegion, IsOnePieceAlsoWhereItIsSeenAslant) {
  TriangleMesh mesh;
  add_sheet(mesh, {0, -0.2f, -0.1f}, {0, 0.4f, 0}, {0.02f, 0, 0.1f});     // the front
  add_sheet(mesh, {0.02f, -0.2f, 0}, {0, 0.4f, 0}, {-0.30f, 0, -0.14f});  // the top, at about 10 degrees
  const auto scans = seen(mesh, 1, 0.6, 64);
  const ObjectRegion region = find_object(scans);
  EXPECT_EQ(region.clusters, 1u) << region.text();
  EXPECT_LT(region.box.min().x(), -0.2);
}

TEST(ObjectRegion, IsTheLargestOfTwo) {
  TriangleMesh mesh;
  add_box(mesh, {-0.12f, -0.30f, 0}, {0.12f, -0.02f, 0.2f});
  add_box(mesh, {-0.05f, 0.25f, 0}, {0.05f, 0.35f, 0.1f});
  add_table(mesh);
  const ObjectRegion region = find_object(seen(mesh));
  ASSERT_EQ(region.planes.size(), 1u) << region.text();
  EXPECT_GE(region.clusters, 2u);
  for (const Vector3f& p : region.points) ASSERT_LT(p.y(), 0.01f);
}

TEST(ObjectRegion, StandsBeforeAWall) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    TriangleMesh mesh;
    c.add(mesh);
    add_table(mesh);
    add_sheet(mesh, {-0.6f, -0.8f, 0}, {0, 1.6f, 0}, {0, 0, 0.8f});
    const ObjectRegion region = find_object(seen(mesh));
    EXPECT_EQ(region.planes.size(), 2u) << region.text();
    for (const Vector3f& p : region.points) ASSERT_GT(p.x(), -0.3f) << region.text();
    EXPECT_GT(region.points.size(), 1000u);
  }
}

TEST(ObjectRegion, PlanesAreKeptWhereThatIsAskedFor) {
  TriangleMesh mesh;
  add_box(mesh, {-0.12f, -0.15f, 0}, {0.12f, 0.15f, 0.2f});
  add_table(mesh);
  ObjectRegionConfig config;
  config.remove_planes = false;
  const ObjectRegion region = find_object(seen(mesh), config);
  EXPECT_TRUE(region.planes.empty());
  EXPECT_GT(region.box.sizes().x(), 1.0);
}

TEST(ObjectRegion, IsTheSameForTheSameInput) {
  TriangleMesh mesh;
  add_part(mesh);
  add_table(mesh);
  const auto scans = seen(mesh);
  const ObjectRegion a = find_object(scans), b = find_object(scans);
  EXPECT_EQ(a.box.min(), b.box.min());
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.planes.at(0).normal, b.planes.at(0).normal);
}

TEST(ObjectRegion, OfNothingIsEmpty) {
  const ObjectRegion region = find_object({});
  EXPECT_TRUE(region.box.isEmpty());
  EXPECT_EQ(region.text(), "no object was found in the scan");
}

TEST(ObjectRegion, CanBeStopped) {
  TriangleMesh mesh;
  add_part(mesh);
  add_table(mesh);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_ANY_THROW(find_object(seen(mesh, 1), {}, stop.get_token()));
}

}  // namespace
}  // namespace nextview
