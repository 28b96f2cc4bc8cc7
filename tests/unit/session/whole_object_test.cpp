// What is said of an object's file before anybody is asked whether to leave what is open for it.
#include <gtest/gtest.h>

#include "core/session/object_mesh.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/mesh/tetrahedron_files.hpp"

namespace nextview {
namespace {

class WholeObject : public testing::Test {
 protected:
  using Path = std::filesystem::path;

  /// Why a file is refused, in one line; empty if it is not.
  template <class Read>
  static std::string refusal(const Read& read) {
    try {
      read();
      return "";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
  }
  static std::string at_once(const Path& file) {
    return refusal([&] { require_whole_object(file); });
  }
  static std::string by_reader(const Path& file) {
    return refusal([&] { load_object_mesh(file); });
  }
  void expect_refused(const Path& file) const {
    EXPECT_NE(at_once(file), "") << file;
    EXPECT_EQ(at_once(file), by_reader(file));
  }

  TemporaryFolder folder_;
};

TEST_F(WholeObject, MeshesThatAreCutOffAreRefusedInTheWordsOfWhoReadsThem) {
  for (const auto& [name, bytes] : tetrahedron_files::all()) {
    EXPECT_EQ(at_once(folder_.write(name, bytes)), "") << name;
    const Path cut = folder_.write("cut_" + name, bytes.substr(0, bytes.size() / 2));
    if (cut.extension() != ".obj") expect_refused(cut);  // which does not say how much there is of it
  }
}

TEST_F(WholeObject, SoAreCloudsAndWhatIsEmptyOrNotThere) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "0 0 0\n";
  const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n0 0 0\n";
  expect_refused(folder_.write("cut.ply", ply));
  expect_refused(folder_.write("cut.pcd", pcd));
  EXPECT_EQ(at_once(folder_.write("whole.ply", ply + "1 0 0\n")), "");
  EXPECT_EQ(at_once(folder_.write("whole.pcd", pcd + "1 0 0\n")), "");
  expect_refused(folder_.write("empty.stl", ""));
  expect_refused(folder_ / "none.stl");
}

TEST_F(WholeObject, OthersAreLeftToWhoReadsThem) {
  for (const char* name : {"map.ot", "scans.graph", "part.stl.gz"}) EXPECT_EQ(at_once(folder_.write(name, "")), "");
  const Path large = folder_.write("large.stl", "solid");
  std::filesystem::resize_file(large, 33u << 20);
  EXPECT_EQ(at_once(large), "") << "it would take a while";
}

}  // namespace
}  // namespace nextview
