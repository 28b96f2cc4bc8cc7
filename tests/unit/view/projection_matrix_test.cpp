// Cameras as 3 x 4 projection matrices: taken apart, read from files and folders, put where the object is.
#include "core/view/projection_matrix.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "core/view/candidate_views.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const Pose pose = make_pose({1.0, -2.0, 3.5}, Eigen::Quaterniond(0.5, -0.3, 0.7, 0.2).normalized());
const Eigen::Matrix3d k = (Eigen::Matrix3d() << 2892.3, 0.0, 823.2, 0.0, 2883.2, 619.1, 0.0, 0.0, 1.0).finished();

std::string text_of(const ProjectionMatrix& p, const char* between_rows = "\n") {
  std::string text;
  for (int r = 0; r < 3; ++r)
    text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {}", p(r, 0), p(r, 1), p(r, 2), p(r, 3), between_rows);
  return text;
}

ProjectionMatrix projection(const Pose& T_world_camera) { return k * T_world_camera.inverse().matrix().topRows<3>(); }

/// Of a ring around (10, 20, 600), in millimetres as DTU's.
Pose ring_pose(int i) {
  const Vector3 middle(10.0, 20.0, 600.0);
  return look_at(middle + Vector3(500.0 * std::cos(0.5 * i), 500.0 * std::sin(0.5 * i), 40.0 * i), middle);
}

class Projections : public ::testing::Test {
 protected:
  Projections() { fs::create_directories(folder_); }
  ~Projections() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// The reason, which must be one line; empty if they are read.
  static std::string why(const fs::path& path) {
    try {
      read_projections(path);
      return "";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
  }
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("nextview_projections_{}", ::getpid());
};

TEST(ProjectionMatrix, IsTakenApartAndPutTogetherAgain) {
  for (const double factor : {1.0, -0.37, 250.0}) {
    const ProjectionMatrix p = factor * projection(pose);
    const DecomposedProjection found = decompose_projection(p);
    EXPECT_NEAR(found.fx, 2892.3, 1e-7);
    EXPECT_NEAR(found.fy, 2883.2, 1e-7);
    EXPECT_NEAR(found.cx, 823.2, 1e-7);
    EXPECT_NEAR(found.cy, 619.1, 1e-7);
    EXPECT_LT((found.T_world_camera.matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_TRUE(is_pose(found.T_world_camera));
  }
  EXPECT_THROW(decompose_projection(ProjectionMatrix::Zero()), std::invalid_argument);
  EXPECT_THROW(decompose_projection(ProjectionMatrix::Constant(NAN)), std::invalid_argument);
}

TEST(ProjectionMatrix, PixelsThatAreNoRectanglesTurnNoCamera) {
  Eigen::Matrix3d skewed = k;
  skewed(0, 1) = 35.0;
  const DecomposedProjection found = decompose_projection(skewed * pose.inverse().matrix().topRows<3>());
  EXPECT_NEAR(found.fx, 2892.3, 1e-7);
  EXPECT_NEAR(found.cx, 823.2, 1e-7);
  EXPECT_LT((found.T_world_camera.matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-10);
}

/// A camera far beyond a kilometre is one whose unit is another.
TEST_F(Projections, CamerasStandWithinAKilometre) {
  CandidateViewsConfig config;
  config.layout = ViewLayout::file;
  config.unit = LengthUnit::metres;
  const auto read = [&](double x) {
    config.file = write("p.txt", text_of(projection(look_at(Vector3(x, 0, 0), Vector3::Zero())))).string();
    return candidate_views(config, Vector3::Zero());
  };
  EXPECT_NEAR(read(999.0).at(0).translation().x(), 999.0, 1e-6);
  EXPECT_THROW(read(1001.0), std::runtime_error);
  EXPECT_THROW(read(-1001.0), std::runtime_error);
}

TEST_F(Projections, TurnWithTheObjectsFile) {
  CandidateViewsConfig config;
  config.layout = ViewLayout::file;
  config.file = write("p.txt", text_of(projection(look_at(Vector3(1, 2, 3), Vector3::Zero())))).string();
  config.projections = {Vector3::Zero(), 1.0, UpAxis::y};
  const Pose view = candidate_views(config, Vector3::Zero()).at(0);
  EXPECT_TRUE(is_pose(view));
  EXPECT_LT((view.translation() - Vector3(1, -3, 2)).norm(), 1e-9) << "2 along the file's y is up";
  EXPECT_LT((view * Vector3(0, 0, std::sqrt(14.0))).norm(), 1e-9) << "it still looks at the object";
}

TEST_F(Projections, AFileHasThreeLinesOrOne) {
  for (const std::string& text : {text_of(projection(pose)), text_of(projection(pose), "\r\n"),
                                  text_of(projection(pose), ""), "\n" + text_of(projection(pose), " ") + "\n\n"}) {
    EXPECT_TRUE(has_projections(text));
    const auto views = read_projections(write("p.txt", text));
    ASSERT_EQ(views.size(), 1u) << text;
    EXPECT_LT((views[0].matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-9);
  }
  const std::string both = text_of(projection(pose)) + "\n" + text_of(projection(ring_pose(3)));
  EXPECT_EQ(read_projections(write("p.txt", both)).size(), 2u);
  for (const char* other : {"", "2\n", "0 0 0 0 0 0 1\n", "four words of text\n"}) EXPECT_FALSE(has_projections(other));
}

TEST_F(Projections, AFolderIsReadInNaturalOrderAndTheRestPassedOver) {
  for (int i = 1; i <= 12; ++i) write(fmt::format("pos_{}.txt", i), text_of(projection(ring_pose(i))));
  write("readme.txt", "Calibration of that day\n");
  write("a_table.csv", "1,2,3,4\n");
  fs::create_directories(folder_ / "deeper");
  std::string said;
  const auto views = read_projections(folder_, [&](const std::string& text) { said += text; });
  ASSERT_EQ(views.size(), 12u);
  for (int i = 1; i <= 12; ++i)
    EXPECT_LT((views[i - 1].matrix() - ring_pose(i).matrix()).cwiseAbs().maxCoeff(), 1e-6) << i;
  EXPECT_THAT(said, HasSubstr(": 2 files without a projection matrix passed over: a_table.csv, …"));
}

TEST_F(Projections, WhatIsWrongIsOneLineThatNamesTheFile) {
  ProjectionMatrix flat = projection(pose);
  flat.row(1) = 2.0 * flat.row(0);
  EXPECT_THAT(why(write("p.txt", "\n" + text_of(flat))), HasSubstr("p.txt:2: the projection matrix is no camera's"));
  EXPECT_THAT(why(write("p.txt", "0 0 0 0\n0 0 0 0\n0 0 0 0\n")), HasSubstr("p.txt:1: the projection matrix"));
  EXPECT_THAT(why(write("p.txt", "1 0 0 nan\n0 1 0 0\n0 0 1 0\n")), HasSubstr("p.txt:1: 'nan' is no finite number"));
  EXPECT_THAT(why(write("p.txt", "1 0 0 0\n0 one 0 0\n0 0 1 0\n")), HasSubstr("p.txt:2: 'one' is no finite number"));
  EXPECT_THAT(why(write("p.txt", "1 0 0 0\n0 1 0 0\n")), HasSubstr("p.txt:1: a 3 x 4 projection matrix has three"));
  EXPECT_THAT(why(write("p.txt", "1 0 0 0\n0 1 0\n0 0 1 0\n")), HasSubstr("p.txt:2: expected 4 numbers"));
  EXPECT_THAT(why(write("p.txt", "hello\n")), HasSubstr("p.txt:1: expected a 3 x 4 projection matrix"));
  EXPECT_THAT(why(folder_), HasSubstr("none of its 1 file holds a 3 x 4 projection matrix"));
  EXPECT_THAT(why(folder_ / "none"), HasSubstr("none"));
  write("pos_001.txt", text_of(projection(pose)));
  write("pos_002.txt", "1 0 0 0\n0 1 0 0\n");
  EXPECT_THAT(why(folder_), HasSubstr("pos_002.txt:1: ")) << "a broken one is not passed over";
}

TEST_F(Projections, AreCandidatesWhereTheObjectIs) {
  CandidateViewsConfig config;
  config.layout = ViewLayout::file;
  config.file = write("p.txt", text_of(projection(ring_pose(1)))).string();
  EXPECT_THROW(candidate_views(config, Vector3::Zero()), std::invalid_argument) << "in no known unit";
  config.unit = LengthUnit::millimetres;
  EXPECT_LT((candidate_views(config, Vector3::Zero())[0].translation() - 1e-3 * ring_pose(1).translation()).norm(),
            1e-9);
  config.projections = {Vector3(10.0, 20.0, 600.0), 0.002};
  const Pose view = candidate_views(config, Vector3(5, 5, 5)).at(0);
  EXPECT_LT((view.translation() - 0.002 * (ring_pose(1).translation() - Vector3(10.0, 20.0, 600.0))).norm(), 1e-9);
  EXPECT_LT((view * Vector3(0, 0, view.translation().norm())).norm(), 1e-9) << "looks at the object's middle";
  config.projections.scale = 10.0;
  EXPECT_THROW(candidate_views(config, Vector3::Zero()), std::runtime_error) << "kilometres off";
}

TEST_F(Projections, DamageIsSurvived) {
  std::mt19937 random(8);
  for (int n = 0; n < 200; ++n) {
    std::string text = text_of(projection(pose));
    for (int c = 0; c < 3; ++c) text[random() % text.size()] = char(random());
    why(write("p.txt", text.substr(0, random() % text.size())));
    why(folder_);
  }
}

}  // namespace
}  // namespace nextview
