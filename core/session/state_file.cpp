#include "core/session/state_file.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/file/atomic_file.hpp"
#include "core/file/bytes.hpp"
#include "core/file/read_file.hpp"
#include "core/map/brick_archive.hpp"
#include "core/memory/available_memory.hpp"
#include "core/session/timings.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "nextview state 4\n";
constexpr std::uintmax_t largest = std::uintmax_t{4} << 30;  // [bytes]

// What a value is made of, in one order for writing and reading; `Archive` is a ByteWriter or a ByteReader.

template <class Archive, class PoseValue>
void each(Archive& archive, PoseValue& pose) requires std::is_same_v<std::remove_const_t<PoseValue>, Pose> {
  for (int i = 0; i < 16; ++i) archive(pose.matrix()(i / 4, i % 4));
  if (!is_pose(pose)) throw std::runtime_error("no pose");
}

template <class Archive, class Optional, class Each>
void each_optional(Archive& archive, Optional& value, const Each& each_of) {
  bool there = value.has_value();
  archive(there);
  if constexpr (!std::is_const_v<Optional>)
    if (there) value.emplace();
  if (there) each_of(*value);
}

template <class Archive, class Quality>
void each_quality(Archive& archive, Quality& q) {
  archive(q.voxels, q.log_loss, q.brier, q.divergence, q.divergence_outside_band, q.calibration_error);
  for (auto& bin : q.reliability) archive(bin.voxels, bin.mean_probability, bin.occupied_share);
}

template <class Archive, class Registration>
void each_registration(Archive& archive, Registration& r) {
  each(archive, r.T_corrected_believed);
  archive(r.shift, r.rotation, r.overlap, r.residual_before, r.residual_after, r.constrained, r.reliable, r.why_not);
}

template <class Archive, class Candidates>
void each_candidate(Archive& archive, Candidates& candidates) {
  std::uint64_t count = candidates.size();
  archive(count);
  if constexpr (!std::is_const_v<Candidates>) {
    if (count > 100'000) throw std::runtime_error("too many candidates");
    candidates.resize(count);
  }
  for (auto& c : candidates) archive(c.available, c.gain, c.cost, c.utility, c.seconds, c.unreachable);
}

/// All but a refinement, and the seconds that it took: those stand apart (timings.hpp), and the file is the same each
/// time.
template <class Archive, class Record>
void each_record(Archive& archive, Record& r) {
  archive(r.step, r.view, r.overridden);
  each(archive, r.T_world_camera);
  archive(r.motion.distance, r.motion.rotation, r.motion.seconds, r.gain, r.gain_unit, r.utility, r.new_surface,
          r.surface_left, r.realised_gain, r.hits, r.misses, r.points, r.new_voxels, r.entropy, r.total_entropy,
          r.coverage_recorded, r.coverage, r.coverage_visible, r.coverage_any_pose, r.coverage_paper);
  each_quality(archive, r.quality);
  each_quality(archive, r.quality_near_surface);
  each_optional(archive, r.registration, [&](auto& registration) { each_registration(archive, registration); });
  each_candidate(archive, r.candidates);
  archive(r.ranking.best, r.ranking.degenerate, r.ranking.reason, r.ranking.gain_unit);
}

template <class Archive, class ViewValue>
void each_view(Archive& archive, ViewValue& view) {
  each(archive, view.T_world_camera);
  archive(view.frame);
}

template <class Archive, class Next>
void each_next(Archive& archive, Next& next) {
  each_view(archive, next.view);
  archive(next.candidate, next.is_custom, next.overridden, next.gain, next.utility, next.gain_unit);
}

template <class Archive, class Taken>
void each_taken(Archive& archive, Taken& taken) {
  each_view(archive, taken.wanted);
  each(archive, taken.T_world_camera);
  archive(taken.expected_new_surface, taken.new_surface);
}

/// What the file holds for: another one is no use.
std::string key_of(const Session& session, std::span<const JournalStep> line, const fs::path& folder) {
  std::string key = "nextview " NEXTVIEW_VERSION "\n" + to_toml(session.configuration(), folder);
  for (const JournalStep& step : line) key += fmt::format("{} {} {}\n", step.number, step.hash.crc32, step.hash.bytes);
  // The journal has the hash of what is scanned, and of nothing else that the state follows from.
  const auto add_file = [&](const fs::path& file) {
    const FileHash hash = file_hash(file);
    key += fmt::format("{} {}\n", hash.crc32, hash.bytes);
  };
  if (session.recording() && !session.object_file().empty()) add_file(session.object_file());
  if (const std::string& start = session.configuration().map.start; !start.empty()) add_file(start);
  return key;
}

bool can_be_kept(const Session& session) {
  const ScanState& state = session.state();
  const Knowledge& known = state.known;
  // Refinements are not in the file: those from before the planner was changed to one without would be lost.
  const auto is_whole = [&](const auto& record) {
    return record->candidates.size() == state.candidates.size() && !record->refinement;
  };
  return state.has_maps && known.scanned && !known.posterior && !known.reference && !state.records.empty() &&
         std::ranges::all_of(state.records, is_whole) &&
         state.candidates == session.setup().candidates->candidates(nothing_scanned(session.setup(), {}).known);
}

void write_evaluation(ByteWriter& writer, const EvaluationState& evaluation) {
  const auto bytes = [](std::span<const std::uint8_t> span) {
    return std::vector<std::uint8_t>(span.begin(), span.end());
  };
  writer(evaluation.seen, bytes(evaluation.coverage.observed()), bytes(evaluation.coverage_paper.observed()),
         evaluation.visited_voxels.words());
}

void read_evaluation(ByteReader& reader, EvaluationState& evaluation) {
  std::vector<std::uint8_t> seen, observed, observed_paper;
  std::vector<std::uint64_t> visited;
  reader(seen, observed, observed_paper, visited);
  if (seen.size() != evaluation.seen.size()) throw std::runtime_error("it is of another object");
  evaluation.seen = std::move(seen);
  evaluation.coverage.set_observed(std::move(observed));
  evaluation.coverage_paper.set_observed(std::move(observed_paper));
  evaluation.visited_voxels.set_words(std::move(visited));
}

std::vector<float> coordinates(const PointCloud& points) {
  const float* const first = points.empty() ? nullptr : points.front().data();
  return {first, first + 3 * points.size()};
}

/// The scans again: their hits as they were cleaned, all else from their captures.
void read_scans(ByteReader& reader, ScanState& state, std::span<const JournalStep> line, const fs::path& folder) {
  std::vector<std::vector<float>> hits(line.size());
  for (auto& points : hits) reader(points);
  state.scans.resize(line.size());
  tbb::parallel_for(std::size_t{0}, line.size(), [&](std::size_t k) {
    Scan scan = to_scan(read_capture(line[k], folder), nullptr).scan;
    if (hits[k].size() != 3 * state.records[k]->points) throw std::runtime_error("it is of another scan");
    scan.hits.resize(hits[k].size() / 3);
    for (std::size_t i = 0; i < scan.hits.size(); ++i) scan.hits[i] = Eigen::Vector3f(&hits[k][3 * i]);
    if (!std::ranges::all_of(hits[k], [](float x) { return std::isfinite(x); })) throw std::runtime_error("no points");
    state.scans[k] = std::make_shared<const Scan>(std::move(scan));
  });
}

ScanState state_in(ByteReader& reader, const Session& session, std::span<const JournalStep> line,
                   const fs::path& folder) {
  const ScanSetup& setup = session.setup();
  ScanState state = nothing_scanned(setup, {});
  std::vector<StageSeconds> timings = read_timings(folder);
  timings.resize(line.size());
  for (std::size_t k = 0; k < line.size(); ++k) {
    StepRecord record;
    each_record(reader, record);
    record.seconds = timings[k];
    if (record.candidates.size() != state.candidates.size() ||
        record.ranking.best.value_or(0) >= std::max<std::size_t>(1, state.candidates.size()) ||
        (record.view >= 0 && std::size_t(record.view) >= state.candidates.size()))
      throw std::runtime_error("it is of other candidates");
    state.records.push_back(std::make_shared<const StepRecord>(std::move(record)));
  }
  state.known.taken.resize(line.size());
  for (TakenView& taken : state.known.taken) each_taken(reader, taken);
  each_next(reader, state.next);
  if (state.next.candidate.value_or(0) >= std::max<std::size_t>(1, state.candidates.size()))
    throw std::runtime_error("it is of other candidates");
  const auto is_of_the_recording = [&](const View& view) {
    return view.frame.value_or(0) < setup.source.frames.size();
  };
  if (session.recording() && !(std::ranges::all_of(state.known.taken, is_of_the_recording, &TakenView::wanted) &&
                               is_of_the_recording(state.next.view)))
    throw std::runtime_error("it is of other frames");
  reader(state.finished);
  each(reader, state.T_world_camera);
  read_bricks(reader, state.known.map);
  auto scanned = std::make_shared<ScannedSurface>(*state.known.scanned);
  scanned->archive(reader);
  state.known.scanned = std::move(scanned);
  if (state.evaluation) {
    auto evaluation = std::make_shared<EvaluationState>(*state.evaluation);
    read_evaluation(reader, *evaluation);
    state.evaluation = std::move(evaluation);
  }
  read_scans(reader, state, line, folder);
  if (!reader.at_end()) throw std::runtime_error("it is longer than it should be");
  return state;
}

}  // namespace

bool write_state_file(const Session& session, std::span<const JournalStep> line, const fs::path& file) {
  const ScanState& state = session.state();
  if (!can_be_kept(session) || line.size() != state.records.size()) return false;
  const std::string key = key_of(session, line, file.parent_path());
  const auto write = [&](std::function<void(std::string_view)> sink) {
    ByteWriter writer(std::move(sink));
    writer(key);
    for (const auto& record : state.records) each_record(writer, *record);
    for (const TakenView& taken : state.known.taken) each_taken(writer, taken);
    each_next(writer, state.next);
    writer(state.finished);
    each(writer, state.T_world_camera);
    write_bricks(writer, state.known.map.voxels());
    state.known.scanned->archive(writer);
    if (state.evaluation) write_evaluation(writer, *state.evaluation);
    for (const auto& scan : state.scans) writer(coordinates(scan->hits));
    writer.finish();
  };
  HashOfParts sum;  // of what is written then: all of it at once would take as much memory as the map
  write([&](std::string_view bytes) { sum.add(bytes); });
  AtomicFile out(file);
  out.stream() << magic << sum.hash().crc32 << '\n';
  write([&](std::string_view bytes) { out.stream() << bytes; });
  out.commit();
  return true;
}

std::optional<ScanState> read_state_file(const Session& session, std::span<const JournalStep> line,
                                         const fs::path& folder) {
  if (line.empty() || !is_there(folder / state_file_name)) return std::nullopt;
  try {
    const std::string bytes = read_file(folder / state_file_name, largest);
    constexpr std::size_t checksum = 8, head = magic.size() + checksum + 1;
    std::string_view content = bytes;
    if (content.size() < head || !content.starts_with(magic)) return std::nullopt;
    const std::string_view wanted = content.substr(magic.size(), checksum);
    content.remove_prefix(head);
    if (hash_of(content).crc32 != wanted) return std::nullopt;
    ByteReader reader(content);
    std::string key;
    reader(key);
    if (key != key_of(session, line, folder)) return std::nullopt;
    return state_in(reader, session, line, folder);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::exception&) {  // what it says is worked out again
    return std::nullopt;
  }
}

ScanState earlier_state(const ScanSetup& setup, const ScanState& state, std::size_t views, const Pose& reached) {
  const auto first = [&](const auto& all) {
    return std::decay_t<decltype(all)>(all.begin(), all.begin() + std::ptrdiff_t(views));
  };
  ScanState earlier = nothing_scanned(setup, reached);
  earlier.scans = first(state.scans);
  earlier.records = first(state.records);
  earlier.known.taken = first(state.known.taken);
  earlier.has_maps = false;
  earlier.next = proposal(setup, earlier);
  return earlier;
}

}  // namespace nextview
