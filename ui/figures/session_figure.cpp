#include "ui/figures/session_figure.hpp"

#include "core/setting/length_text.hpp"
#include "ui/charts/scan_curves.hpp"
#include "ui/layers/ray_segments.hpp"

namespace nextview {
namespace {

/// Points drawn at most: more do not show, and a software renderer feels each.
constexpr std::size_t max_points = 150'000;

PointCloud thinned(const std::vector<std::shared_ptr<const Scan>>& scans) {
  std::size_t total = 0;
  for (const auto& scan : scans) total += scan->hits.size();
  const std::size_t stride = total / max_points + 1;
  PointCloud points;
  std::size_t i = 0;
  for (const auto& scan : scans)
    for (const Eigen::Vector3f& p : scan->hits)
      if (i++ % stride == 0) points.push_back(p);
  return points;
}

ScanCourse course_of(const Session& session) {
  return {session.records(), session.setup().start_entropy, session.setup().d_reg(), session.planner().unit(),
          session.known_object() != nullptr};
}

}  // namespace

StepPicture step_picture(const Session& session) {
  const StepRecord& last = session.records().back();
  const Configuration& c = session.configuration();
  StepPicture picture;
  picture.step = last.step;
  picture.step_count = c.termination.views;
  picture.object_name = session.object_file().empty() ? session.name() : session.object_file().stem().string();
  picture.gain_name = c.planner.gain;
  picture.gain_unit = session.planner().unit();
  picture.object = session.mesh().get();
  picture.grid = session.map().grid();
  picture.voxels = session.planning_voxels().dense();
  picture.cloud = thinned(session.scans());
  picture.camera = session.camera();
  picture.candidates = session.candidates();
  picture.chosen = session.next_candidate();
  picture.ranking_note = last.ranking.degenerate;
  picture.reason = last.ranking.reason.substr(0, last.ranking.reason.find(" Runner-up"));
  for (const Candidate& candidate : last.candidates) {
    if (!candidate.unreachable.empty()) picture.unreachable.push_back(picture.scores.size());
    picture.scores.push_back(candidate.gain);
    picture.utilities.push_back(candidate.utility);
  }
  for (const StepRecord& r : session.records()) picture.path.push_back(r.T_world_camera);
  const ScanState& state = session.state();
  for (std::size_t v = 0; v < state.candidates.size(); ++v)
    if (state.known.has_taken(state.candidates[v])) picture.taken.push_back(v);
  if (picture.chosen) {
    if (const auto explanation = session.explain(*picture.chosen))
      picture.rays = ray_segments(*explanation, session.next_view().translation(), picture.grid.resolution);
    picture.ray_values = {picture.gain_name + " along rays", picture.gain_unit};
  }
  ChartSeries unmeasured{"unmeasured entropy (Eq. 18)", {}, {}}, total{"total entropy, sum of H(p)", {}, {}};
  ChartSeries visible{"of the visible surface", {}, {}}, all{"of all the surface", {}, {}};
  ChartSeries recorded{"of what all frames show", {}, {}};
  for (const StepRecord& r : session.records()) {
    for (ChartSeries* series : {&unmeasured, &total, &visible, &all, &recorded}) series->x.push_back(r.step);
    recorded.y.push_back(100.0 * r.coverage_recorded.value_or(0.0));
    unmeasured.y.push_back(r.entropy / 1e6);
    total.y.push_back(r.total_entropy / 1e6);
    visible.y.push_back(100.0 * r.coverage_visible);
    all.y.push_back(100.0 * r.coverage);
  }
  picture.entropy.y_unit = "Mbit";
  picture.entropy.series = {unmeasured, total};
  picture.coverage.title = "Surface coverage at d_reg = " + length_text(session.setup().d_reg());
  if (session.known_object()) picture.coverage.series = {visible, all};
  if (session.recording()) picture.coverage.series.insert(picture.coverage.series.begin(), recorded);
  if (picture.coverage.series.empty()) picture.coverage = gain_chart(course_of(session));  // no truth is known
  return picture;
}

std::vector<ChartContent> session_charts(const Session& session) {
  ScanCourse course = course_of(session);
  std::optional<CoverageByOrder> orders;
  const auto taken = frames_taken(session.state().known);
  if (const RecordedSurface* recorded = session.setup().recorded.get(); recorded && !taken.empty()) {
    orders = recorded->compare_orders(taken, session.configuration().seed);
    course.orders = &*orders;
  }
  return scan_charts(course);
}

void SessionFigure::write(const Session& session, const std::filesystem::path& file) {
  StepPicture picture = step_picture(session);
  if (!session.finished().empty()) {
    picture.finished = session.finished();
    picture.reason.clear();
    picture.chosen.reset();  // no view follows
    picture.rays.clear();
  }
  figure_.show(picture);
  target_.render();
  write_png(target_.read_back(), file);
}

}  // namespace nextview
