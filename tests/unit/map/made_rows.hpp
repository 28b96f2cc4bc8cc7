#pragma once
#include <random>
#include <vector>

#include "core/map/bit_rows.hpp"

/// Rows of flags to try things on.
namespace nextview::made_rows {

/// Calls `visit(cell)` for all voxels of a box, x fastest.
template <class Visit>
void for_each_cell(const Eigen::Vector3i& size, Visit visit) {
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) visit(Eigen::Vector3i(x, y, z));
}

inline BitRows random_rows(std::mt19937& random, const Eigen::Vector3i& size, double share) {
  std::bernoulli_distribution is(share);
  BitRows rows(size);
  for_each_cell(size, [&](const Eigen::Vector3i& cell) {
    if (is(random)) rows.set(cell);
  });
  return rows;
}

/// Those that are set, x fastest.
inline std::vector<Eigen::Vector3i> cells(const BitRows& rows) {
  std::vector<Eigen::Vector3i> set;
  for_each_cell(rows.size(), [&](const Eigen::Vector3i& cell) {
    if (rows.at(cell)) set.push_back(cell);
  });
  return set;
}

}  // namespace nextview::made_rows
