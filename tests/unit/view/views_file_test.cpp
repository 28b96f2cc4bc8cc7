#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "core/view/candidate_views.hpp"

namespace nextview {
namespace {

class ViewsFile : public testing::Test {
 protected:
  ViewsFile()
      : file_(std::filesystem::temp_directory_path() /
              ("nextview_views_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name() + ".txt")) {}
  ~ViewsFile() override { std::filesystem::remove(file_); }

  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }
  std::vector<Pose> read(const std::string& text) const {
    write(text);
    return read_views(file_);
  }
  /// The reason, which must name the file and be one line; empty if the text is read.
  std::string reason(const std::string& text) const {
    try {
      read(text);
      return "";
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(file_.string()), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      return what;
    }
  }
  std::filesystem::path file_;
};

constexpr const char* two_views =
    "2\n"
    "0.1 0.2 0.3 0 0 0 1\n"
    "-1 2e-1 3.5 0.5 0.5 0.5 0.5\n";

TEST_F(ViewsFile, IsReadAsWritten) {
  const std::vector<Pose> views = read(two_views);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].translation(), Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(views[0].linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(views[1].translation(), Vector3(-1, 0.2, 3.5));
  // (x y z w) = (½ ½ ½ ½) takes x to y, y to z and z to x.
  EXPECT_LT((views[1].linear() * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-12);
  EXPECT_LT((views[1].linear() * Vector3::UnitY() - Vector3::UnitZ()).norm(), 1e-12);
}

TEST_F(ViewsFile, MayBeginWithComments) {
  EXPECT_EQ(read(std::string("# as export writes them\n#\n") + two_views).size(), 2u);
  EXPECT_EQ(read("# poses: x y z qx qy qz qw, in metres\n0.1 0.2 0.3 0 0 0 1\n").size(), 1u);
  EXPECT_NE(reason("# one\n0 0 0 0 0 0 1\nx\n").find(":3: expected a view"), std::string::npos);
}

TEST_F(ViewsFile, GivesCandidatesIndependentOfTheTarget) {
  write(two_views);
  CandidateViewsConfig config;
  config.layout = ViewLayout::file;
  config.file = file_.string();
  config.count = 7;
  for (const Vector3& target : {Vector3(0, 0, 0), Vector3(1, 2, 3)}) {
    const std::vector<Pose> views = candidate_views(config, target);
    ASSERT_EQ(views.size(), 2u);
    EXPECT_EQ(views[1].translation(), Vector3(-1, 0.2, 3.5));
  }
}

TEST_F(ViewsFile, AcceptsCarriageReturnsAndNoFinalNewline) {
  EXPECT_EQ(read("1\r\n0.1 0.2 0.3 0 0 0 1\r\n").size(), 1u);
  EXPECT_EQ(read("1\n0.1 0.2 0.3 0 0 0 1").size(), 1u);
}

TEST_F(ViewsFile, MayHaveNoCount) {
  const std::string views = std::string(two_views).substr(2);
  const std::vector<Pose> without = read(views), with = read(two_views);
  ASSERT_EQ(without.size(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(without[i].matrix(), with[i].matrix());
  EXPECT_EQ(read(views + "\n \n").size(), 2u) << "blank lines at the end";
  EXPECT_NE(reason("0.1 0.2 0.3 0 0 0\n" + views), "") << "a view of six numbers first";
  EXPECT_NE(reason(views + "2\n").find(":3"), std::string::npos) << "the count comes first";
  EXPECT_NE(reason("\n" + views), "");
  EXPECT_NE(reason("step,view\n1,7\n").find(":1: expected views as `x y z qx qy qz qw` a line"), std::string::npos);
}

TEST_F(ViewsFile, OneViewIsReadFromAText) {
  EXPECT_EQ(parse_view("0.1 0.2 0.3 0 0 0 1").matrix(), read(two_views)[0].matrix());
  for (const char* bad :
       {"", "1 2 3", "1 2 3 0 0 0 1 0", "1 2 3 0 0 0 2", "1 2 nan 0 0 0 1", "1,2,3,0,0,0,1", "1e7 2 3 0 0 0 1"})
    EXPECT_THROW(parse_view(bad), std::invalid_argument) << bad;
}

/// By one in a thousand at most; written with four digits they are off by less.
TEST_F(ViewsFile, QuaternionsMayBeALittleOff) {
  for (const char* good : {"0 0 0 0 0 0 1.0009", "0 0 0 0 0 0 0.9991", "0 0 0 0 0 0 -1"})
    EXPECT_NO_THROW(parse_view(good)) << good;
  for (const char* bad : {"0 0 0 0 0 0 1.0011", "0 0 0 0 0 0 0.9989", "0 0 0 1 0 0 0.1"})
    EXPECT_THROW(parse_view(bad), std::invalid_argument) << bad;
}

TEST_F(ViewsFile, ViewsLieWithinAMillionMetres) {
  for (const char* good : {"1e6 0 0 0 0 0 1", "0 -1e6 0 0 0 0 1", "0 0 1e6 0 0 0 1"}) EXPECT_NO_THROW(parse_view(good));
  for (const char* bad : {"1000001 0 0 0 0 0 1", "0 -1000001 0 0 0 0 1", "0 0 1000001 0 0 0 1"})
    EXPECT_THROW(parse_view(bad), std::invalid_argument) << bad;
}

TEST_F(ViewsFile, HoldsAHundredThousandViewsAtMost) {
  std::string views;
  for (int i = 0; i < 100'000; ++i) views += "0 0 0 0 0 0 1\n";
  EXPECT_EQ(read(views).size(), 100'000u);
  EXPECT_EQ(read("100000\n" + views).size(), 100'000u);
  EXPECT_NE(reason(views + "0 0 0 0 0 0 1\n"), "");
  EXPECT_NE(reason("100001\n" + views + "0 0 0 0 0 0 1\n"), "");
}

TEST_F(ViewsFile, RoundedQuaternionsAreMadeUnit) {
  const std::vector<Pose> views = read("1\n0 0 0 0.3827 0 0 0.9239\n");
  EXPECT_LT((views[0].linear().transpose() * views[0].linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST_F(ViewsFile, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(reason(""), "");
  EXPECT_NE(reason("\n\n"), "");
  EXPECT_NE(reason("views\n"), "");
  EXPECT_NE(reason("-1\n"), "");
  EXPECT_NE(reason("0\n"), "");
  EXPECT_NE(reason("1.5\n0 0 0 0 0 0 1\n"), "");
  EXPECT_NE(reason("999999999999999999999999\n0 0 0 0 0 0 1\n"), "");
  EXPECT_NE(reason("1000000000\n0 0 0 0 0 0 1\n"), "");
  EXPECT_NE(reason("2\n0 0 0 0 0 0 1\n"), "") << "one view of two";
  EXPECT_NE(reason("1\n0 0 0 0 0 0 1\n0 0 0 0 0 0 1\n"), "") << "two views of one";
  EXPECT_NE(reason("1\n0 0 0 0 0 1\n"), "") << "six numbers";
  EXPECT_NE(reason("1\n0 0 0 0 0 0 1 5\n"), "") << "eight numbers";
  EXPECT_NE(reason("1\n0 0 0 0 0 0 one\n"), "");
  EXPECT_NE(reason("1\n0 0 nan 0 0 0 1\n"), "");
  EXPECT_NE(reason("1\n0 0 inf 0 0 0 1\n"), "");
  EXPECT_NE(reason("1\n0 0 0 0 0 0 nan\n"), "");
  EXPECT_NE(reason("1\n0 0 0 0 0 0 1e999\n"), "");
  EXPECT_NE(reason("1\n0 0 0 0 0 0 0\n"), "") << "zero quaternion";
  EXPECT_NE(reason("1\n0 0 0 1 1 1 1\n"), "") << "quaternion of length 2";
  EXPECT_NE(reason("1\n0 0 0 0 0 0 1e300\n"), "");
  const std::string third = reason("3\n0 0 0 0 0 0 1\n0 0 0 0 0 0 1\n0 0 0 0 x 0 1\n");
  EXPECT_NE(third.find(":4"), std::string::npos) << "names no line: " << third;
}

TEST_F(ViewsFile, MissingFilesAndFoldersAreErrors) {
  for (const std::filesystem::path& path : {std::filesystem::path("/nonexistent/views.txt"), file_.parent_path()}) {
    try {
      read_views(path);
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  }
}

// A cut within the last number may leave a shorter number; every other cut is noticed.
TEST_F(ViewsFile, TruncatedAnywhereIsNoCrash) {
  const std::string text = two_views;
  const std::size_t last_number = text.rfind(' ') + 1;
  for (std::size_t length = 0; length < text.size() - 1; ++length) {
    const std::string why = reason(text.substr(0, length));
    if (length <= last_number) {
      EXPECT_NE(why, "") << length;
    }
  }
}

TEST_F(ViewsFile, GarbageIsNoCrash) {
  std::mt19937 random(8);
  for (int n = 0; n < 100; ++n) {
    std::string text = two_views;
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = char(random());
    reason(text);
    std::string noise(random() % 300, ' ');
    for (char& c : noise) c = char(random());
    EXPECT_NE(reason(noise), "");
  }
}

}  // namespace
}  // namespace nextview
