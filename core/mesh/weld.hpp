#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace nextview {

/// For each vertex a number that vertices at exactly the same place share, counted from 0 in the order of first
/// appearance.
std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3f>& vertices);

}  // namespace nextview
