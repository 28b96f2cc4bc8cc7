#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/file/atomic_file.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "ui/demo/demo_frames.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {

/// Demos of a small scan.
class Demos : public InTemporaryFolder {
 protected:
  Demos() {
    announce_panels(standard_panels());  // demos name them
    write_file(folder_ / "tiny.toml", to_toml(tiny_scan()));
  }
  Demo demo(std::string text, const std::filesystem::path& out = {}) const {
    if (const auto at = text.find("tiny.toml"); at != text.npos) text.insert(at, folder_.string() + "/");
    write_file(folder_ / "demo.nextview", text);
    return read_demo((folder_ / "demo.nextview").string(), out);
  }
  /// As a demo of this text says its mistake; empty if it has none, and plays.
  std::string error_of(const std::string& text, bool plays = false) const {
    try {
      const Demo read = demo(text);
      if (plays) play_demo(read, small, [](const Image&, int) {});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  static std::vector<Image> frames(const Demo& demo, const DemoPictures& pictures) {
    std::vector<Image> all;
    play_demo(demo, pictures, [&](const Image& frame, int number) {
      EXPECT_EQ(number, int(all.size()) + 1);
      all.push_back(frame);
    });
    return all;
  }

  static constexpr DemoPictures small{{320, 180}, 4};
};

/// Says the name of the first that differs, not megabytes of pixels.
inline void expect_same(const std::vector<Image>& a, const std::vector<Image>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i] == b[i]) << "frame " << i + 1;
}

}  // namespace nextview
