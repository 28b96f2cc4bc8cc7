#include "ui/workbench/step_tree.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/session/step_outcome.hpp"
#include "core/setting/setting.hpp"

namespace nextview {
namespace {

/// Its numbers, which are all that curves and the timeline show.
std::shared_ptr<const StepRecord> without_candidates(StepRecord record) {
  record.candidates.clear();
  return std::make_shared<const StepRecord>(std::move(record));
}

std::shared_ptr<const DepthCells> picture_of(const Scan& scan, const Pose& T_world_camera,
                                             const PinholeCamera& camera) {
  return std::make_shared<const DepthCells>(thumbnail(scan, T_world_camera, camera));
}

std::shared_ptr<const DepthCells> picture_of(const JournalStep& step, const std::filesystem::path& folder,
                                             const PinholeCamera& camera) {
  try {
    const Scan scan = to_scan(read_capture(step, folder), nullptr).scan;
    return picture_of(scan, step.T_world_camera, camera);
  } catch (const std::runtime_error&) {
    return nullptr;  // who goes there hears of it
  }
}

}  // namespace

void StepTree::add(std::shared_ptr<SavedSession> saved) {
  const Journal& journal = *saved->journal;
  std::vector<std::uint32_t> line;  // whose pictures come with their scans
  for (const JournalStep& step : journal.line()) line.push_back(step.number);
  for (const auto& [number, step] : journal.steps) {
    Node node{step.after};
    if (!journal.steps.contains(step.after)) {  // where that is lost: the one before
      const auto next = journal.steps.upper_bound(step.after);
      node.after = next == journal.steps.begin() ? 0 : std::prev(next)->first;
    }
    if (!step.outcome.empty()) {
      StepRecord record = record_with(step.outcome);
      record.T_world_camera = step.T_world_camera;
      node.record = without_candidates(std::move(record));
    }
    if (!std::ranges::binary_search(line, number)) node.picture = picture_of(step, saved->folder, camera_);
    nodes_.emplace(number, std::move(node));
  }
  branches = journal.branches;
  for (Branch& branch : branches.all)  // of a tip that is lost, too
    if (!nodes_.contains(branch.tip)) branch.tip = std::prev(nodes_.upper_bound(branch.tip))->first;
  saved_ = std::move(saved);
}

bool StepTree::step(std::uint32_t number, Stand stand) {
  if (has(number)) throw std::logic_error("a step is taken once");
  nodes_[number].after = at;
  const bool begins_branch = branches.add_step(number, at);
  set_stand(number, std::move(stand));
  at = number;
  return begins_branch;
}

void StepTree::set_stand(std::uint32_t number, Stand stand) {
  Node& node = nodes_.at(number);
  if (number > 0) {
    const StepRecord& record = *stand.state->records.back();
    node.record = without_candidates(record);
    if (!node.picture) node.picture = picture_of(*stand.state->scans.back(), record.T_world_camera, camera_);
  }
  node.stand = std::move(stand);
}

void StepTree::follow_seen(std::uint32_t number) {
  const Node& node = nodes_.at(number);
  const auto& before = nodes_.at(node.after).stand;
  SeenSurface& seen = *node.stand->seen;
  if (seen.scans() == 0 && before) seen = *before->seen;
  seen.follow(node.stand->state->scans);
  seen.compare(node.stand->state->scans);
}

void StepTree::take_pictures(std::span<const std::uint32_t> numbers, const ScanState& state) {
  tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t k) {
    nodes_.at(numbers[k]).picture = picture_of(*state.scans[k], state.records[k]->T_world_camera, camera_);
  });
}

std::vector<std::uint32_t> StepTree::line(std::uint32_t number) const {
  std::vector<std::uint32_t> line;
  for (; number > 0; number = nodes_.at(number).after) line.push_back(number);
  std::ranges::reverse(line);
  return line;
}

bool StepTree::leads_through(std::uint32_t tip, std::uint32_t number) const {
  while (tip > number) tip = nodes_.at(tip).after;
  return tip == number;
}

void StepTree::go_back_to(const Branches& then) {
  branches =
      branches.back_to(then, [&](std::uint32_t tip, std::uint32_t number) { return leads_through(tip, number); });
}

std::vector<JournalStep> StepTree::not_here(std::uint32_t number) const {
  std::vector<JournalStep> steps;
  for (; !nodes_.at(number).stand; number = nodes_.at(number).after) steps.push_back(saved_->journal->steps.at(number));
  std::ranges::reverse(steps);
  return steps;
}

std::uint32_t StepTree::nearest_here(std::uint32_t number) const {
  while (!nodes_.at(number).stand) number = nodes_.at(number).after;
  return number;
}

const ScanState* StepTree::nearest_maps(std::uint32_t number, const Stand& like) const {
  for (;; number = nodes_.at(number).after) {
    const auto& stand = nodes_.at(number).stand;
    if (stand && stand->state->has_maps && stand->needs.occlusions == like.needs.occlusions &&
        stand->needs.posterior == like.needs.posterior &&
        stand->planning.planner.semantics == like.planning.planner.semantics &&
        (!like.needs.posterior || same_settings(stand->planning.gibbs, like.planning.gibbs)))
      return stand->state.get();
    if (number == 0) return nullptr;
  }
}

std::vector<std::pair<ScanState*, const ScanState*>> StepTree::states() const {
  std::vector<std::pair<ScanState*, const ScanState*>> states;
  for (const auto& [number, node] : nodes_) {
    if (!node.stand) continue;
    const auto& before = nodes_.at(node.after).stand;
    states.emplace_back(node.stand->state.get(), number > 0 && before ? before->state.get() : nullptr);
  }
  return states;
}

Timeline StepTree::timeline() const {
  Timeline timeline{{}, branches, at};
  for (const auto& [number, node] : nodes_)
    if (number > 0) timeline.steps.push_back({number, node.after, node.record, node.picture});
  return timeline;
}

}  // namespace nextview
