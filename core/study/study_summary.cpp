#include "core/study/study_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/csv_cell.hpp"
#include "core/file/json_text.hpp"
#include "core/setting/rounded.hpp"
#include "core/study/summary_rows.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int digits = 6;  // more than any of the numbers means
std::string number(double value) { return fmt::format("{:.{}g}", value, digits); }

std::string csv_row(const SummaryRow& r) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}-{},{},{}\n", r.part, r.block, csv_cell(r.object),
                     csv_cell(r.sensor), r.views, csv_cell(r.method), csv_cell(r.measure), number(r.at), r.runs,
                     r.measure == "failure" ? "" : number(r.mean), r.measure == "failure" ? "" : number(r.spread),
                     r.better ? std::to_string(*r.better) : "", r.first_run, r.last_run, r.hash, csv_cell(r.note));
}

Json json_row(const SummaryRow& r) {
  Json json = {{"part", r.part},       {"block", r.block}, {"object", r.object},
               {"sensor", r.sensor},   {"views", r.views}, {"method", r.method},
               {"measure", r.measure}, {"at", r.at},       {"runs", r.runs}};
  if (r.measure != "failure") json["mean"] = rounded(r.mean, digits), json["spread"] = rounded(r.spread, digits);
  if (r.better) json["better"] = *r.better;
  json["of_runs"] = {r.first_run, r.last_run};
  json["hash"] = r.hash;
  if (!r.note.empty()) json["reason"] = r.note;
  return json;
}

/// summary.csv, summary.json and runs.csv, as their rows come.
class SummaryFiles {
 public:
  SummaryFiles(const Study& study, const fs::path& out)
      : csv_(out / "summary.csv"), json_(out / "summary.json"), runs_(out / "runs.csv") {
    csv_.stream() << "part,block,object,sensor,views,method,measure,at,runs,mean,spread,better,of_runs,hash,note\n";
    json_.stream() << "{\"program\": \"nextview " NEXTVIEW_VERSION "\", \"study\": " << json_text(Json(study.name))
                   << ", \"rows\": [";
    runs_.stream() << "run,key,part,object,sensor,views,method,start,seed,measure,value,failure\n";
  }

  void add(const SummaryRow& row) {
    csv_.stream() << csv_row(row);
    json_.stream() << (rows_++ == 0 ? "\n" : ",\n") << json_text(json_row(row));
  }
  void add(const FinishedRun& run) {
    const char* measure = main_measure(run.run.part);
    const MeasuredValue* value = run.result.find(measure, 0.0);
    runs_.stream() << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", run.number, run.key, name(run.run.part),
                                  csv_cell(run.run.object), csv_cell(run.run.sensor), run.run.views,
                                  csv_cell(run.run.method), run.run.start, run.run.seed, csv_cell(measure),
                                  value ? number(value->value) : "", csv_cell(run.result.failure));
  }
  std::size_t commit() {
    json_.stream() << "\n]}\n";
    for (AtomicFile* file : {&csv_, &json_, &runs_}) file->commit();
    return rows_;
  }

 private:
  AtomicFile csv_, json_, runs_;
  std::size_t rows_ = 0;
};

/// Finds results in several folders. Shards took the runs in turns, so the next is likely in the next folder.
class Results {
 public:
  explicit Results(std::span<const StudyFolder> folders) : folders_(folders) {}
  RunResult read(const std::string& key) {
    for (std::size_t i = 0; i < folders_.size(); ++i) {
      const std::size_t folder = (next_ + i) % folders_.size();
      if (!folders_[folder].has(key)) continue;
      next_ = folder + 1;
      return folders_[folder].result(key);
    }
    return folders_.front().result(key);  // it was there a moment ago
  }

 private:
  std::span<const StudyFolder> folders_;
  std::size_t next_ = 0;
};

}  // namespace

void require_results(std::span<const std::string> keys, std::span<const StudyFolder> folders, const RunRange& range) {
  constexpr std::size_t most_named = 5;
  std::vector<std::size_t> missing;
  for (std::size_t number = range.first; number <= range.last; ++number)
    if (std::ranges::none_of(folders, [&](const StudyFolder& folder) { return folder.has(keys[number - 1]); }))
      missing.push_back(number);
  if (missing.empty()) return;
  std::vector<std::string> in;
  for (const StudyFolder& folder : folders) in.push_back(folder.path().string());
  const std::size_t named = std::min(most_named, missing.size());
  throw std::runtime_error(fmt::format(
      "{}: {} of {} {} not done{} ({}{}); {}", fmt::join(in, ", "), missing.size(), counted(keys.size(), "run"),
      missing.size() == 1 ? "is" : "are", in.size() > 1 ? " in any of them" : "",
      fmt::join(missing.begin(), missing.begin() + std::ptrdiff_t(named), ", "), named < missing.size() ? ", …" : "",
      "--merge needs the folders of all shards, and --resume goes on with one that is not done"));
}

StudySummary summarise(const Study& study, std::span<const std::string> keys, std::span<const StudyFolder> folders,
                       const RunRange& range, const fs::path& out) {
  require_results(keys, folders, range);
  StudySummary summary;
  SummaryFiles files(study, out);
  Results results(folders);
  std::size_t begin = 0;
  for (const StudyBlock& block : study.blocks) {
    SummaryRows rows(block, [&](const SummaryRow& row) { files.add(row); });
    const std::size_t together = block.methods.size() * block.runs_of_a_method();
    for (std::size_t first = begin; first < begin + block.size(); first += together) {
      std::vector<FinishedRun> runs;
      for (std::size_t i = first; i < first + together; ++i) {
        if (i + 1 < range.first || i + 1 > range.last) continue;
        runs.push_back({i + 1, keys[i], study.run(i), results.read(keys[i])});
        files.add(runs.back());
        summary.failed += runs.back().result.failure.empty() ? 0 : 1;
      }
      rows.add(runs);
      summary.runs += runs.size();
    }
    rows.finish();
    begin += block.size();
  }
  summary.rows = files.commit();
  return summary;
}

}  // namespace nextview
