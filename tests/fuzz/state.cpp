// What a session keeps to be opened in a moment, with check sum and key as they have to be: an input says what is
// written over a good one, by records of 4 bytes for the place, one for the number of bytes (1 to 8), and these.
#include <fmt/format.h>

#include <cstring>

#include "core/file/read_file.hpp"
#include "core/session/session_folder.hpp"
#include "core/session/state_file.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

namespace {

using namespace nextview;

Configuration small_scan() {
  Configuration c;
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply";
  c.sensor.width = 8;
  c.sensor.height = 6;
  c.map.resolution = 0.1;
  c.map.region_edge = 0.8;
  c.views.count = 4;
  c.planner.ray_columns = c.planner.ray_rows = 2;
  c.termination.views = 3;
  c.evaluation.surface_samples = 100;
  return c;
}

/// A session with two views, and the file that it left, taken apart.
struct Kept {
  Session session{small_scan()};
  std::filesystem::path folder = fuzzed_file("session/unused", "").parent_path() / "made";
  std::vector<JournalStep> line;
  std::string head, key, state;

  Kept() {
    SessionFolder made = SessionFolder::begin(OutputFolder(folder, {}), session);
    made.step(session);
    made.step(session);
    made.keep_state(session);
    made.close();
    line = read_journal(folder).line();
    const std::string bytes = read_file(folder / state_file_name);
    head = bytes.substr(0, bytes.find('\n') + 1);
    std::string_view content = std::string_view(bytes).substr(head.size() + 9);  // 8 digits of check sum, a line's end
    std::uint64_t key_size = 0;
    std::memcpy(&key_size, content.data(), sizeof key_size);
    key = content.substr(0, sizeof key_size + key_size);
    state = content.substr(key.size());
    require(read_state_file(session, line, folder).has_value(), "a state that was just kept is read");
  }
};

std::string written_over(std::string state, std::string_view patches) {
  while (patches.size() > 5) {
    std::uint32_t place = 0;
    std::memcpy(&place, patches.data(), sizeof place);
    place %= state.size();
    const std::size_t wanted = 1 + (static_cast<unsigned char>(patches[4]) & 7);
    patches.remove_prefix(5);
    const std::size_t count = std::min({wanted, patches.size(), state.size() - place});
    state.replace(place, count, patches.substr(0, count));
    patches.remove_prefix(count);
  }
  return state;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Kept kept;
  const std::string content = kept.key + written_over(kept.state, {reinterpret_cast<const char*>(data), size});
  fuzzed_file("session/made/state", kept.head + hash_of(content).crc32 + "\n" + content);
  auto state = read_state_file(kept.session, kept.line, kept.folder);
  if (!state || size % 8 != 0) return 0;  // it takes its time
  try {                                   // what is taken for a state is one that can be gone on from
    kept.session.restore(*std::move(state));
    kept.session.step();
  } catch (const std::runtime_error&) {
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
