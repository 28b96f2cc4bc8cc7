#include "core/session/taken_views.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "core/file/read_file.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {

std::vector<Pose> views_taken(const std::filesystem::path& file, std::span<const Pose> candidates, const Pose& start) {
  std::istringstream text(read_file(file, std::uintmax_t{1} << 24));
  std::string line;
  std::getline(text, line);
  std::vector<Pose> poses;
  for (int number = 2; std::getline(text, line); ++number) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream row(line);
    int step = 0, view = 0;
    Vector3 p;
    Eigen::Quaterniond q;
    row >> step >> view >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w();
    const bool whole = !row.fail() && (row >> std::ws).eof();
    if (!whole || view < -1 || view >= int(candidates.size()) || std::abs(q.norm() - 1.0) > 1e-6 || !p.allFinite())
      throw std::runtime_error(fmt::format("{}:{}: not a view of this scan", file.string(), number));
    const Pose written = make_pose(p, q);
    const Pose& exact = view >= 0 ? candidates[view] : start;
    const bool is_exact = (view >= 0 || step == 1) && written.isApprox(exact, 1e-6);
    poses.push_back(is_exact ? exact : written);
  }
  if (poses.empty()) throw std::runtime_error(fmt::format("{}: holds no view", file.string()));
  return poses;
}

std::vector<Pose> views_taken(const std::filesystem::path& file, const Configuration& c) {
  return views_taken(file, candidate_views(c.views, view_target(c)), configured_start_view(c));
}

}  // namespace nextview
