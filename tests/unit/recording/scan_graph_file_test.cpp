#include "core/recording/scan_graph_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ScanGraph.h>

#include <fstream>
#include <sstream>

#include "core/file/read_file.hpp"
#include "tests/unit/recording/made_recording.hpp"

namespace nextview {
namespace {

using made_recording::failure_of;
using testing::HasSubstr;

/// Two scans of random points, with an edge between them.
void fill(octomap::ScanGraph& graph) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(-3.0f, 3.0f);
  for (int i = 0; i < 2; ++i) {
    auto* cloud = new octomap::Pointcloud;  // the graph deletes it
    for (int k = 0; k < 20 + 10 * i; ++k) cloud->push_back(anywhere(random), anywhere(random), anywhere(random));
    graph.addNode(cloud, octomap::pose6d(0.5f + static_cast<float>(i), -1.0f, 2.0f, 0.3f, -0.4f, 1.2f));
  }
  graph.connectPrevious();
}

/// In the world, as OctoMap itself puts points there.
std::vector<Vector3> points_by_octomap(octomap::ScanNode& node) {
  std::vector<Vector3> points;
  for (const auto& point : *node.scan) {
    const octomap::point3d p = node.pose.transform(point);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  return points;
}

void expect_as_octomap(const std::filesystem::path& file, octomap::ScanGraph& graph) {
  const std::vector<ScanGraphNode> nodes = read_scan_graph(file);
  ASSERT_EQ(nodes.size(), graph.size());
  auto expected = graph.begin();
  for (const ScanGraphNode& node : nodes) {
    const std::vector<Vector3> points = read_scan_graph_points(file, node), there = points_by_octomap(**expected);
    ASSERT_EQ(points.size(), there.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_LT((node.T_world_camera * points[i] - there[i]).norm(), 1e-5);
    const auto forward = (*expected)->pose.rot().rotate(octomath::Vector3(1, 0, 0));
    EXPECT_LT((node.T_world_camera.linear().col(2) - Vector3(forward.x(), forward.y(), forward.z())).norm(), 1e-6);
    ++expected;
  }
}

TEST(ScanGraphFile, BinaryIsAsOctomapWritesIt) {
  const TemporaryFolder folder;
  octomap::ScanGraph graph;
  fill(graph);
  ASSERT_TRUE(graph.writeBinary((folder / "a.graph").string()));
  expect_as_octomap(folder / "a.graph", graph);
}

TEST(ScanGraphFile, TextIsAsOctomapReadsIt) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.log",
                                 "# made\nNODE 1 2 3 0.1 -0.2 0.3\n1 0 0\n0 2.5 0\nNODE 0 0 0 0 0 1.5\n"
                                 "-1 -2 -3\n\nNODE 5 5 5 -3 1 2\n");
  octomap::ScanGraph graph;
  std::istringstream text("NODE 1 2 3 0.1 -0.2 0.3\n1 0 0\n0 2.5 0\nNODE 0 0 0 0 0 1.5\n-1 -2 -3\nNODE 5 5 5 -3 1 2\n");
  graph.readPlainASCII(text);
  expect_as_octomap(file, graph);
}

TEST(ScanGraphFile, ARealOneIsAsOctomapReadsIt) {
  const auto file = std::filesystem::path(NEXTVIEW_SHARED_DIR) / "data/maps/spherical_scan.graph";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "an addition: " << file << " is not there";
  octomap::ScanGraph graph;
  ASSERT_TRUE(graph.readBinary(file.string()));
  expect_as_octomap(file, graph);
}

TEST(ScanGraphFile, WhatCannotBeRightIsOneLine) {
  const TemporaryFolder folder;
  octomap::ScanGraph graph;
  fill(graph);
  ASSERT_TRUE(graph.writeBinary((folder / "a.graph").string()));
  const std::string bytes = read_file(folder / "a.graph");
  const auto why = [&](const std::string& name, const std::string& content) {
    const auto file = folder.write(name, content);
    return failure_of([&] {
      for (const ScanGraphNode& node : read_scan_graph(file)) read_scan_graph_points(file, node);
    });
  };
  EXPECT_THAT(why("cut.graph", bytes.substr(0, bytes.size() / 2)), HasSubstr("cut.graph: "));
  EXPECT_THAT(why("short.graph", "ab"), HasSubstr("is truncated"));
  EXPECT_THAT(why("many.graph", "\xff\xff\xff\x7f" + bytes.substr(4)), HasSubstr("more than it can hold"));
  EXPECT_THAT(why("points.graph", bytes.substr(0, 4) + "\xff\xff\xff\xff" + bytes.substr(8)),
              HasSubstr("4294967295 points"));
  EXPECT_THAT(why("a.log", "NODE 1 2 3\n"), HasSubstr("a.log:1: expected `NODE"));
  EXPECT_THAT(why("b.log", "NODE 1 2 3 0 0 0\n1 2\n"), HasSubstr("b.log:2: expected a point"));
  EXPECT_THAT(why("c.log", "# none\n"), HasSubstr("holds no line"));
}

TEST(ScanGraphFile, DamageIsSurvived) {
  const TemporaryFolder folder;
  octomap::ScanGraph graph;
  fill(graph);
  ASSERT_TRUE(graph.writeBinary((folder / "whole").string()));
  const auto read = [](const auto& file) {
    for (const ScanGraphNode& node : read_scan_graph(file)) read_scan_graph_points(file, node);
  };
  made_recording::survives_damage(folder, "a.graph", read_file(folder / "whole"), read);
  made_recording::survives_damage(folder, "a.log", "NODE 1 2 3 0.1 0.2 0.3\n1.5 2.5 3.5\n-1e-3 2 3\n", read);
}

}  // namespace
}  // namespace nextview
