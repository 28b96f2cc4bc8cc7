#include "core/surface/surface_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "core/file/atomic_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "tests/unit/map/closed_meshes.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

/// A sphere of radius 0.1 m whose uncertainty rises with z from 0 to 2 mm; its lower third is not seen.
Surface partly_seen_sphere() {
  Surface surface;
  surface.mesh = closed_meshes::sphere(Vector3(0.2, -0.1, 0.05), 0.1, 4);
  for (const Eigen::Vector3f& v : surface.mesh.vertices) {
    const float height = (v.z() - 0.05f + 0.1f) / 0.2f;
    surface.uncertainty.push_back(0.002f * std::max(0.0f, height));
    surface.seen.push_back(height > 1.0f / 3.0f);
  }
  return surface;
}

/// A triangle in the plane z = 0, seen.
Surface triangle() {
  Surface surface;
  surface.mesh.vertices = {{0, 0, 0}, {0.25f, 0, 0}, {0, 0.5f, 0}};
  surface.mesh.triangles = {{0, 1, 2}};
  surface.uncertainty = {0.0f, 0.001f, 0.002f};
  surface.seen = {1, 1, 0};
  return surface;
}

template <class T>
T value(const std::string& bytes, std::size_t at) {
  T result;
  std::memcpy(&result, bytes.data() + at, sizeof result);
  return result;
}

Eigen::Vector3f vector(const std::string& bytes, std::size_t at) {
  return {value<float>(bytes, at), value<float>(bytes, at + 4), value<float>(bytes, at + 8)};
}

/// The one line that writing fails with.
template <class Error, class Write>
std::string complaint(Write write) {
  try {
    write();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no complaint";
}

std::string stl_complaint(const TriangleMesh& mesh, const std::filesystem::path& file) {
  return complaint<std::invalid_argument>([&] { write_stl(mesh, file); });
}
std::string ply_complaint(const Surface& surface, const std::filesystem::path& file) {
  return complaint<std::invalid_argument>([&] { write_ply(surface, file); });
}

TEST(Stl, isBinaryInMillimetresWithNormals) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = partly_seen_sphere().mesh;
  write_stl(mesh, folder / "a.stl");
  const std::string bytes = read_file(folder / "a.stl");
  ASSERT_EQ(bytes.size(), 84 + 50 * mesh.triangles.size());
  EXPECT_TRUE(bytes.starts_with("nextview, unit mm"));
  EXPECT_EQ(value<std::uint32_t>(bytes, 80), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t at = 84 + 50 * t;
    const Eigen::Vector3f normal = vector(bytes, at), a = vector(bytes, at + 12), b = vector(bytes, at + 24),
                          c = vector(bytes, at + 36);
    ASSERT_EQ(a, 1000.0f * mesh.vertices[mesh.triangles[t][0]]);
    ASSERT_EQ(b, 1000.0f * mesh.vertices[mesh.triangles[t][1]]);
    ASSERT_EQ(c, 1000.0f * mesh.vertices[mesh.triangles[t][2]]);
    ASSERT_NEAR(normal.norm(), 1.0f, 1e-6f);
    ASSERT_NEAR(normal.dot(b - a), 0.0f, 1e-3f);
    ASSERT_GT(normal.dot(a - Eigen::Vector3f(200, -100, 50)), 90.0f) << "the normal does not point outwards";
    ASSERT_EQ(value<std::uint16_t>(bytes, at + 48), 0);
  }
}

TEST(Stl, isReadByAnIndependentReader) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = partly_seen_sphere().mesh;
  write_stl(mesh, folder / "a.stl");
  const TriangleMesh read = load_mesh(folder / "a.stl", {.longest_side = 0.0, .unit = LengthUnit::metres});
  EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(topology(read).summary(), "watertight");
  EXPECT_NEAR(read.bounding_box().sizes().x(), 200.0, 1e-3);
  EXPECT_NEAR(read.surface_area(), 1e6 * mesh.surface_area(), 1.0);
}

TEST(Stl, carriesARemarkThatFitsIntoItsHead) {
  const TemporaryFolder folder;
  write_stl(triangle().mesh, folder / "a.stl", "of box, 3 views");
  EXPECT_TRUE(read_file(folder / "a.stl").starts_with("nextview, unit mm; of box, 3 views" + std::string(3, '\0')));
  write_stl(triangle().mesh, folder / "b.stl", std::string(200, 'x'));
  const std::string bytes = read_file(folder / "b.stl");
  EXPECT_EQ(bytes.size(), 84u + 50u);
  EXPECT_EQ(bytes.substr(0, 80), "nextview, unit mm; " + std::string(40, 'x') + std::string(21, '\0'));
  EXPECT_EQ(value<std::uint32_t>(bytes, 80), 1u);
}

TEST(Stl, leavesOutTrianglesWithoutArea) {
  const TemporaryFolder folder;
  TriangleMesh mesh = triangle().mesh;
  mesh.vertices.push_back({0.125f, 0, 0});
  mesh.triangles = {{0, 1, 1}, {0, 1, 2}, {0, 3, 1}, {2, 2, 2}};
  write_stl(mesh, folder / "a.stl");
  const std::string bytes = read_file(folder / "a.stl");
  EXPECT_EQ(bytes.size(), 84u + 50u);
  EXPECT_EQ(value<std::uint32_t>(bytes, 80), 1u);
  EXPECT_EQ(vector(bytes, 84), Eigen::Vector3f(0, 0, 1));
  mesh.triangles = {{0, 3, 1}};
  EXPECT_THAT(stl_complaint(mesh, folder / "b.stl"), HasSubstr("area"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.stl"));
}

TEST(SurfacePly, holdsWhatItsHeaderSays) {
  const TemporaryFolder folder;
  write_ply(triangle(), folder / "a.ply");
  const std::string bytes = read_file(folder / "a.ply");
  const std::size_t end = bytes.find("end_header\n") + 11;
  const std::string header = bytes.substr(0, end);
  EXPECT_TRUE(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(header, HasSubstr("unit m\n"));
  EXPECT_THAT(header, HasSubstr("from 0 m (dark blue) to 0.001 m"));                   // of the seen vertices
  EXPECT_THAT(header, HasSubstr("comment seen of the area: 0 %, 0 of 0.0625 m^2\n"));  // one corner was not
  EXPECT_THAT(header, HasSubstr("\nelement vertex 3\nproperty uchar seen\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                "property float uncertainty\nelement face 1\n"
                                "property list uchar int vertex_indices\n"));
  ASSERT_EQ(bytes.size(), end + 3 * 20 + 13);
  const Surface surface = triangle();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(vector(bytes, end + 20 * i + 1), surface.mesh.vertices[i]);
    EXPECT_EQ(value<float>(bytes, end + 20 * i + 16), surface.uncertainty[i]);
    EXPECT_EQ(value<std::uint8_t>(bytes, end + 20 * i), surface.seen[i]);
  }
  EXPECT_EQ(bytes.substr(end + 13, 3), "\x2d\x1a\x5a");           // dark blue
  EXPECT_EQ(bytes.substr(end + 20 + 13, 3), "\xf8\xe7\x50");      // yellow
  EXPECT_EQ(bytes.substr(end + 2 * 20 + 13, 3), "\xa0\xa0\xa0");  // not seen
  EXPECT_EQ(bytes[end + 60], 3);
  for (std::uint32_t k = 0; k < 3; ++k) EXPECT_EQ(value<std::uint32_t>(bytes, end + 61 + 4 * k), k);
}

TEST(SurfacePly, isReadAgainWhereACoordinateBeginsWithALineEnd) {
  const TemporaryFolder folder;
  Surface surface = triangle();
  surface.mesh.vertices[0].x() = std::bit_cast<float>(0x3e23d70au);  // 0.16: the lowest byte is 10
  write_ply(surface, folder / "a.ply");
  EXPECT_EQ(load_mesh(folder / "a.ply").triangles.size(), 1u);
}

TEST(SurfacePly, coloursGetLighterAsTheUncertaintyRises) {
  const TemporaryFolder folder;
  Surface strip;
  for (int i = 0; i <= 100; ++i) {
    strip.mesh.vertices.push_back({0.001f * float(i), i % 2 ? 0.01f : 0.0f, 0.0f});
    strip.uncertainty.push_back(i < 96 ? 1e-5f * float(i) : 1.0f);  // 96 of 101 are over 95 %
    strip.seen.push_back(1);
  }
  for (std::uint32_t i = 0; i + 2 <= 100; ++i) strip.mesh.triangles.push_back({i, i + 1, i + 2});
  write_ply(strip, folder / "a.ply");
  const std::string bytes = read_file(folder / "a.ply");
  EXPECT_THAT(bytes, HasSubstr("to 0.00095 m and more"));
  const std::size_t end = bytes.find("end_header\n") + 11;
  const auto luminance = [&](std::size_t i) {
    const auto channel = [&](std::size_t c) {
      return std::pow(double(value<std::uint8_t>(bytes, end + 20 * i + 13 + c)) / 255.0, 2.2);
    };
    return 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
  };
  for (std::size_t i = 1; i < 96; ++i) EXPECT_GT(luminance(i), luminance(i - 1)) << i;
  EXPECT_EQ(luminance(96), luminance(95));
}

TEST(SurfacePly, isReadByAnIndependentReader) {
  const TemporaryFolder folder;
  const Surface surface = partly_seen_sphere();
  write_ply(surface, folder / "a.ply");
  const PlacedMesh read = load_placed_mesh(folder / "a.ply", {.longest_side = 0.0, .unit = LengthUnit::metres});
  EXPECT_EQ(read.mesh.vertices.size(), surface.mesh.vertices.size());
  ASSERT_EQ(read.mesh.triangles.size(), surface.mesh.triangles.size());
  for (std::size_t t = 0; t < read.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f written = surface.mesh.vertices[surface.mesh.triangles[t][k]];
      const Vector3 found = read.mesh.vertices[read.mesh.triangles[t][k]].cast<double>();
      ASSERT_NEAR((found - read.placement(written.cast<double>())).norm(), 0.0, 1e-7);
    }
}

TEST(SurfacePly, ofASurfaceThatNobodySawIsGrey) {
  const TemporaryFolder folder;
  Surface surface = triangle();
  surface.seen = {0, 0, 0};
  write_ply(surface, folder / "a.ply");
  const std::string bytes = read_file(folder / "a.ply");
  EXPECT_THAT(bytes, HasSubstr("\xa0\xa0\xa0"));
  EXPECT_THAT(bytes, testing::Not(HasSubstr("\x2d\x1a\x5a")));
}

TEST(SurfaceFile, refusesWhatIsNoSurface) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* why, auto spoil) {
    Surface surface = triangle();
    spoil(surface);
    EXPECT_THAT(ply_complaint(surface, folder / "a.ply"), HasSubstr(why));
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  refused("no triangles", [](Surface& s) { s = {}; });
  refused("vertex 1 is not finite", [&](Surface& s) { s.mesh.vertices[1].y() = nan; });
  refused("names vertex 3", [](Surface& s) { s.mesh.triangles[0][2] = 3; });
  refused("uncertainty of vertex 2", [&](Surface& s) { s.uncertainty[2] = nan; });
  refused("uncertainty of vertex 0", [&](Surface& s) { s.uncertainty[0] = -0.001f; });
  refused("2 uncertainties", [&](Surface& s) { s.uncertainty.pop_back(); });
  refused("4 marks", [&](Surface& s) { s.seen.push_back(1); });

  EXPECT_THAT(stl_complaint({}, folder / "a.stl"), HasSubstr("no triangles"));
  TriangleMesh mesh = triangle().mesh;
  mesh.triangles[0][0] = 17;
  EXPECT_THAT(stl_complaint(mesh, folder / "a.stl"), HasSubstr("names vertex 17"));
  mesh = triangle().mesh;
  mesh.vertices[2].x() = 1e38f;  // a number in metres, infinite in millimetres
  EXPECT_THAT(stl_complaint(mesh, folder / "a.stl"), HasSubstr("vertex 2 is not finite"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "")) << "a file was left behind";
}

TEST(SurfaceFile, namesTheFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const Surface surface = partly_seen_sphere();
  const auto stl = [&](const std::string& name) {
    return complaint<std::runtime_error>([&] { write_stl(surface.mesh, folder / name); });
  };
  const auto ply = [&](const std::string& name) {
    return complaint<std::runtime_error>([&] { write_ply(surface, folder / name); });
  };
  EXPECT_THAT(stl("no/such/a.stl"), HasSubstr("no/such/a.stl"));
  EXPECT_THAT(ply("no/such/a.ply"), HasSubstr("no/such/a.ply"));

  // A full disk: files cannot grow over 1000 bytes.
  folder.write("a.stl", "old");
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit small{1000, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string full_stl = stl("a.stl"), full_ply = ply("a.ply");
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(full_stl, HasSubstr("a.stl"));
  EXPECT_THAT(full_ply, HasSubstr("a.ply"));
  EXPECT_EQ(read_file(folder / "a.stl"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.ply"));
}

}  // namespace
}  // namespace nextview
