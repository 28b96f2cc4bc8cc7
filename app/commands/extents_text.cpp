#include "app/commands/extents_text.hpp"

#include <fmt/format.h>

std::string nextview::extents_text(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d size = box.sizes();
  const bool small = size.maxCoeff() < 1.0;
  const double unit = small ? 1e3 : 1.0;
  const auto triple = [&](const Eigen::Vector3d& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", unit * v.x(), unit * v.y(), unit * v.z());
  };
  return fmt::format("{:.4g} x {:.4g} x {:.4g} {}, from {} to {}", unit * size.x(), unit * size.y(), unit * size.z(),
                     small ? "mm" : "m", triple(box.min()), triple(box.max()));
}
