#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

/// Where a node of OctoMap's scan graph stands in its file: graphs may be larger than memory. Its points are in the
/// frame of a body (x forward, z up); here they are turned into that of a camera.
struct ScanGraphNode {
  Pose T_world_camera = Pose::Identity();
  std::uint64_t offset = 0;  ///< of its points [bytes]
  std::uint64_t bytes = 0;   ///< that they take
  std::uint32_t points = 0;  ///< only of binary graphs known
  std::size_t line = 0;      ///< of text: where NODE stands, from 1
};

/// The nodes of a binary graph (.graph), or of a text (.log) of lines `NODE x y z roll pitch yaw`, each followed by its
/// points `x y z` [m, rad]. Edges between nodes are passed over.
/// @throws std::runtime_error "FILE: reason": truncated, claims more than it holds, a pose that is none
std::vector<ScanGraphNode> read_scan_graph(const std::filesystem::path& file);

/// The points of a node [m, camera frame]. @throws as read_scan_graph
std::vector<Vector3> read_scan_graph_points(const std::filesystem::path& file, const ScanGraphNode& node);

}  // namespace nextview
