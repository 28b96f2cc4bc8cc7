// What a user waits for around a scan of 20 views: until its session is shown against reading the files that were made
// of it, going back a view against taking one. Ratios in one run: build/release/session_benchmark
#include <benchmark/benchmark.h>
#include <unistd.h>

#include "core/cloud/point_cloud.hpp"
#include "core/export/scan_files.hpp"
#include "core/export/scan_surfaces.hpp"
#include "core/file/read_file.hpp"
#include "core/map/octree_file.hpp"
#include "core/session/session_folder.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// A closed session of 20 views of the gearbox, with the files that `nextview scan --no-pictures` writes.
class ScannedFolder {
 public:
  ScannedFolder() {
    Session session{Configuration{}};
    SessionFolder folder = SessionFolder::begin(OutputFolder(path(), {}), session);
    while (session.finished().empty()) folder.step(session);
    write_scan(session, folder.out());
    write_surfaces(scan_surfaces(session), folder.out());
    folder.keep_state(session);
    folder.close();
  }
  ScannedFolder(const ScannedFolder&) = delete;
  ~ScannedFolder() { fs::remove_all(path()); }
  static fs::path path() {
    return fs::temp_directory_path() / ("nextview_session_benchmark." + std::to_string(getpid()));
  }
};

fs::path scanned() {
  static const ScannedFolder folder;
  return folder.path();
}

SessionRunner::JobControl job_control() {
  return {[](double, std::string_view) {}, [](const SamplerDiagnostics&) {}, {}};
}

void ReadFiles(benchmark::State& state) {
  scanned();
  for (auto _ : state) {
    for (const char* map : {"map.ot", "map.bt"}) benchmark::DoNotOptimize(read_octree(scanned() / map));
    for (const char* cloud : {"cloud.ply", "surface_map.ply", "surface_cloud.ply"})
      benchmark::DoNotOptimize(read_ply(scanned() / cloud));
    for (const char* table : {"steps.csv", "scores.csv", "views.csv", "metrics.json", "config.toml", "timings.csv"})
      benchmark::DoNotOptimize(read_file(scanned() / table));
  }
}
BENCHMARK(ReadFiles)->Unit(benchmark::kMillisecond)->UseRealTime();

void OpenSession(benchmark::State& state) {
  scanned();
  for (auto _ : state) {
    auto runner = std::make_unique<SessionRunner>();
    SessionRunner::JobControl control = job_control();
    control.shown = [&] { state.PauseTiming(); };  // and can be worked with
    runner->open(scanned(), control);
    runner.reset();
    state.ResumeTiming();
  }
}
BENCHMARK(OpenSession)->Unit(benchmark::kMillisecond)->UseRealTime();

void MakeSession(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Session{Configuration{}}.candidates().size());
}
BENCHMARK(MakeSession)->Unit(benchmark::kMillisecond)->UseRealTime();

void UndoAView(benchmark::State& state) {
  SessionRunner runner;
  runner.open(scanned(), job_control());
  while (runner.catch_up({}))
    ;
  for (auto _ : state) {
    runner.undo(job_control());
    state.PauseTiming();
    runner.redo(job_control());
    state.ResumeTiming();
  }
}
BENCHMARK(UndoAView)->Unit(benchmark::kMillisecond)->UseRealTime();

void TakeAView(benchmark::State& state) {
  SessionRunner runner;
  runner.load(Configuration{}, job_control());
  for (int view = 0; view < 5; ++view) runner.step(job_control());
  for (auto _ : state) {
    runner.step(job_control());
    state.PauseTiming();
    runner.undo(job_control());
    state.ResumeTiming();
  }
}
BENCHMARK(TakeAView)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace nextview

BENCHMARK_MAIN();
