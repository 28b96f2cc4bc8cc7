// What a user waits for around a scan of 20 views: until its session is shown against reading the files that were made
// of it, going back a view against taking one; and what a view adds to memory. Ratios in one run:
// build/release/session_benchmark
#include <benchmark/benchmark.h>
#include <unistd.h>

#include "core/cloud/point_cloud.hpp"
#include "core/export/scan_files.hpp"
#include "core/export/scan_surfaces.hpp"
#include "core/file/read_file.hpp"
#include "core/map/octree_file.hpp"
#include "core/session/session_folder.hpp"
#include "tests/unit/workbench/job_control.hpp"

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

/// What a state holds that the one before it does not, and what of it is the map, as a share of the whole map.
void BytesOfAView(benchmark::State& state) {
  std::vector<double> megabytes, of_map, map_shares;
  for (auto _ : state) {
    Session session{Configuration{}};
    session.step();
    while (session.finished().empty()) {
      const ScanState before = session.state();
      session.step();
      megabytes.push_back(1e-6 * double(bytes_of(session.state(), &before)));
      const VoxelBricks &voxels = session.map().voxels(), &were = before.known.map.voxels();
      of_map.push_back(1e-6 * double(voxels.bytes_beside(were)));
      map_shares.push_back(double(voxels.bytes_beside(were)) / double(voxels.bytes()));
    }
  }
  const auto median = [](std::vector<double>& values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
  };
  state.counters["MB"] = median(megabytes);
  state.counters["map_MB"] = median(of_map);
  state.counters["map_share"] = median(map_shares);
  state.counters["largest_map_share"] = map_shares.back();
}
BENCHMARK(BytesOfAView)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace nextview

BENCHMARK_MAIN();
