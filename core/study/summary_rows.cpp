#include "core/study/summary_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

/// Continues a hash by the keys of more runs.
std::string hash_with(const std::string& hash, const std::string& key) { return text_hash(hash + key); }

double difference_for_the_better(StudyPart part, double difference) {
  return more_is_better(part) ? difference : -difference;
}

SummaryRow row_of(SummaryRow head, const SummaryRows::Place& place, const MeanSpread& values) {
  head.measure = place.first;
  head.at = place.second;
  head.runs = values.count();
  head.mean = values.mean();
  head.spread = values.spread();
  return head;
}

/// Courses of chains and bins of reliability diagrams are told of the means over objects alone: with each object's they
/// would be two fifths of all rows. A run's own are in its file.
bool is_told_of_means_alone(const std::string& measure) {
  static constexpr std::string_view courses[] = {"log_posterior_below_last[nats]", "changed_voxels[%]",
                                                 "d_kl_of_mean[nats]"};
  return measure.starts_with("reliability_") || std::ranges::find(courses, measure) != std::end(courses);
}

SummaryRow gap_row(SummaryRow head, double closed) {
  head.measure = "gap_closed";
  head.runs = 1;
  head.mean = closed;
  return head;
}

}  // namespace

void MeanSpread::add(double value) {
  ++count_;
  const double before = value - mean_;
  mean_ += before / double(count_);
  squares_ += before * (value - mean_);
}

double MeanSpread::spread() const { return count_ < 2 ? 0.0 : std::sqrt(squares_ / double(count_ - 1)); }

std::vector<SummaryRows::Group> SummaryRows::groups_of(const std::vector<FinishedRun>& runs) const {
  std::vector<Group> groups;
  for (const FinishedRun& run : runs) {
    if (groups.empty() || groups.back().head.method != run.run.method) {
      Group group;
      group.head.part = name(run.run.part);
      group.head.block = run.run.block + 1;
      group.head.object = object_label(run.run.object);
      group.head.sensor = run.run.sensor;
      group.head.views = run.run.views;
      group.head.method = run.run.method;
      group.head.first_run = run.number;
      groups.push_back(std::move(group));
    }
    Group& group = groups.back();
    group.head.last_run = run.number;
    group.head.hash = hash_with(group.head.hash, run.key);
    group.runs.push_back(&run);
    for (const auto& [measure, values] : run.result.measured)
      for (const MeasuredValue& m : values) group.means[{measure, m.at}].add(m.value);
  }
  return groups;
}

SummaryRows::OverObjects& SummaryRows::over_objects(const SummaryRow& row) {
  auto found = std::ranges::find_if(over_objects_, [&](const OverObjects& o) {
    return o.head.sensor == row.sensor && o.head.views == row.views && o.head.method == row.method;
  });
  if (found == over_objects_.end()) {
    SummaryRow head;
    head.part = row.part;
    head.block = row.block;
    head.object = mean_object;
    head.sensor = row.sensor;
    head.views = row.views;
    head.method = row.method;
    head.first_run = row.first_run;
    over_objects_.push_back({std::move(head), {}, {}});
    found = over_objects_.end() - 1;
  }
  return *found;
}

void SummaryRows::take(const Group& group, const Place& place, const MeanSpread& values,
                       std::optional<std::size_t> better) {
  SummaryRow row = row_of(group.head, place, values);
  row.better = better;
  if (!is_told_of_means_alone(place.first)) take_(row);
  OverObjects& over = over_objects(row);
  over.means[place].add(row.mean);
  if (better && difference_for_the_better(block_.part, row.mean) > 0.0) ++over.better[place];
}

void SummaryRows::compare(const Group& group, const Group& reference) {
  const std::string measure = main_measure(block_.part);
  MeanSpread differences;
  std::size_t better = 0;
  for (const FinishedRun* run : group.runs) {
    const auto same_otherwise = [&](const FinishedRun* other) {
      return other->run.start == run->run.start && other->run.seed == run->run.seed;
    };
    const auto other = std::ranges::find_if(reference.runs, same_otherwise);
    if (other == reference.runs.end()) continue;
    const MeasuredValue* of_it = run->result.find(measure, 0.0);
    const MeasuredValue* of_other = (*other)->result.find(measure, 0.0);
    if (!of_it || !of_other) continue;
    differences.add(of_it->value - of_other->value);
    if (difference_for_the_better(block_.part, of_it->value - of_other->value) > 0.0) ++better;
  }
  if (differences.count() > 0) take(group, {measure + " - " + reference.head.method, 0.0}, differences, better);
}

template <class Several>
std::vector<std::optional<double>> SummaryRows::gaps_closed(const Several& groups) {
  const Place place{main_measure(StudyPart::planning), 0.0};
  const auto mean_of = [&](const auto& group) -> std::optional<double> {
    const auto found = group.means.find(place);
    return found == group.means.end() ? std::nullopt : std::optional(found->second.mean());
  };
  std::optional<double> random, oracle;
  for (const auto& group : groups) {
    if (group.head.method == "random") random = mean_of(group);
    if (group.head.method == "oracle") oracle = mean_of(group);
  }
  std::vector<std::optional<double>> closed(groups.size());
  if (!random || !oracle || *oracle <= *random) return closed;  // there is no gap
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (const auto mean = mean_of(groups[i])) closed[i] = (*mean - *random) / (*oracle - *random);
  return closed;
}

void SummaryRows::add(const std::vector<FinishedRun>& runs) {
  const std::vector<Group> groups = groups_of(runs);
  for (const Group& group : groups) {
    const auto failed = [](const FinishedRun* run) { return !run->result.failure.empty(); };
    const auto first = std::ranges::find_if(group.runs, failed);
    if (first != group.runs.end()) {
      SummaryRow row = group.head;
      row.measure = "failure";
      row.runs = std::size_t(std::ranges::count_if(group.runs, failed));
      row.note = (*first)->result.failure;
      take_(row);
    }
    for (const auto& [place, values] : group.means) take(group, place, values);
    const auto reference = std::ranges::find(groups, block_.reference, [](const Group& g) { return g.head.method; });
    if (reference != groups.end() && &*reference != &group) compare(group, *reference);
    OverObjects& over = over_objects(group.head);
    over.head.last_run = group.head.last_run;
    over.head.hash = hash_with(over.head.hash, group.head.hash);
  }
  if (block_.part != StudyPart::planning) return;
  const auto closed = gaps_closed(groups);
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (closed[i]) take_(gap_row(groups[i].head, *closed[i]));
}

/// Of the means: mean coverages are averaged over the objects first.
void SummaryRows::finish_gaps() {
  const auto setting = [](const OverObjects& o) { return std::pair(o.head.sensor, o.head.views); };
  for (auto first = over_objects_.begin(); first != over_objects_.end();) {
    std::vector<OverObjects> same;
    while (first != over_objects_.end() && (same.empty() || setting(*first) == setting(same.front())))
      same.push_back(*first++);
    const auto closed = gaps_closed(same);
    for (std::size_t i = 0; i < same.size(); ++i)
      if (closed[i]) take_(gap_row(same[i].head, *closed[i]));
  }
}

void SummaryRows::finish() {
  for (const OverObjects& over : over_objects_)
    for (const auto& [place, values] : over.means) {
      SummaryRow row = row_of(over.head, place, values);
      const auto better = over.better.find(place);
      if (place.first.find(" - ") != std::string::npos) row.better = better == over.better.end() ? 0 : better->second;
      take_(row);
    }
  if (block_.part == StudyPart::planning) finish_gaps();
  over_objects_.clear();
}

}  // namespace nextview
