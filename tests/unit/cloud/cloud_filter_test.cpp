#include <gtest/gtest.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <tuple>

#include "core/cloud/point_cloud.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// A wavy sheet with noise, and a few points far from it.
PointCloud sheet_with_outliers(unsigned seed, int points, int outliers) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> side(-0.25f, 0.25f);
  std::normal_distribution<float> noise(0.0f, 0.002f);
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const float x = side(generator), y = side(generator);
    cloud.emplace_back(x, y, 0.9f + 0.05f * std::sin(20.0f * x) + noise(generator));
  }
  for (int i = 0; i < outliers; ++i)
    cloud.insert(cloud.begin() + i * 7, {side(generator), side(generator), side(generator)});
  return cloud;
}

PointCloud pcl_keeps(const PointCloud& points, const CloudConfig& config) {
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const auto& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setMeanK(config.outlier_neighbours);
  filter.setStddevMulThresh(config.outlier_deviations);
  pcl::Indices indices;
  filter.filter(indices);
  PointCloud kept;
  for (const int i : indices) kept.push_back(points[std::size_t(i)]);
  return kept;
}

TEST(CloudFilter, OutlierRemovalKeepsWhatPclKeeps) {
  for (const unsigned seed : {1u, 2u, 3u})
    for (const int neighbours : {1, 8, 16, 50})
      for (const double deviations : {0.1, 0.5, 1.0, 3.0}) {
        CloudConfig config;
        config.outlier_neighbours = neighbours;
        config.outlier_deviations = deviations;
        const PointCloud cloud = sheet_with_outliers(seed, 1500, 15);
        const PointCloud kept = clean(cloud, config);
        EXPECT_EQ(kept, pcl_keeps(cloud, config)) << seed << ' ' << neighbours << ' ' << deviations;
        EXPECT_LT(kept.size(), cloud.size());
      }
}

TEST(CloudFilter, OutlierRemovalWithEqualPointsKeepsWhatPclKeeps) {
  PointCloud cloud = sheet_with_outliers(5, 300, 3);
  const PointCloud copy = cloud;
  for (int i = 0; i < 5; ++i) cloud.insert(cloud.end(), copy.begin(), copy.end());
  CloudConfig config;
  config.outlier_neighbours = 8;
  config.outlier_deviations = 1.0;
  EXPECT_EQ(clean(cloud, config), pcl_keeps(cloud, config));
}

// A regular grid, as a camera sees a wall: most neighbours are as far as others.
TEST(CloudFilter, OutlierRemovalWithEqualDistancesKeepsWhatPclKeeps) {
  PointCloud cloud;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) cloud.emplace_back(0.01f * float(i), 0.01f * float(j), i % 20 == 0 ? 0.05f : 0.0f);
  for (const int neighbours : {4, 16}) {
    CloudConfig config;
    config.outlier_neighbours = neighbours;
    config.outlier_deviations = 1.0;
    const PointCloud kept = clean(cloud, config);
    EXPECT_EQ(kept, pcl_keeps(cloud, config));
    EXPECT_LT(kept.size(), cloud.size());
  }
}

TEST(CloudFilter, CanBeStopped) {
  std::stop_source stop;
  const PointCloud cloud = sheet_with_outliers(8, 100'000, 0);
  EXPECT_EQ(clean(cloud, {}, stop.get_token()), clean(cloud, {}));
  stop.request_stop();
  EXPECT_THROW(clean(cloud, {}, stop.get_token()), Stopped);
}

TEST(CloudFilter, OutliersGoAndTheSheetStays) {
  PointCloud cloud = sheet_with_outliers(9, 5000, 0);
  const PointCloud sheet = cloud;
  cloud.insert(cloud.begin() + 2500, {0.0f, 0.0f, 0.2f});
  const PointCloud kept = clean(cloud, {});
  for (const auto& p : kept) EXPECT_GT(p.z(), 0.8f);
  EXPECT_GT(kept.size(), sheet.size() * 95 / 100);
}

TEST(CloudFilter, FewPointsAndNone) {
  EXPECT_TRUE(clean({}, {}).empty());
  CloudConfig both;
  both.down_sampling = true;
  EXPECT_TRUE(clean({}, both).empty());
  for (const int points : {1, 2, 3, 16, 17}) {  // 16 neighbours are asked for
    const PointCloud cloud = sheet_with_outliers(4, points, 0);
    EXPECT_EQ(clean(cloud, {}).size(), cloud.size()) << points;
  }
}

TEST(CloudFilter, SwitchedOffItChangesNothing) {
  CloudConfig off;
  off.outlier_removal = false;
  const PointCloud cloud = sheet_with_outliers(6, 500, 5);
  EXPECT_EQ(clean(cloud, off), cloud);
}

TEST(CloudFilter, DownSamplingPutsOneCentroidALeaf) {
  CloudConfig config;
  config.outlier_removal = false;
  config.down_sampling = true;
  config.down_sampling_leaf = 0.015625;  // a power of two, so that the twin rounds alike
  const PointCloud cloud = sheet_with_outliers(7, 3000, 10);
  std::map<std::tuple<int, int, int>, std::pair<Vector3, int>> leaves;  // z, y, x: PCL's order
  for (const auto& p : cloud) {
    const auto cell = [&](float x) { return static_cast<int>(std::floor(x / 0.015625)); };
    auto& [sum, count] = leaves.try_emplace({cell(p.z()), cell(p.y()), cell(p.x())}, Vector3::Zero(), 0).first->second;
    sum += p.cast<double>();
    ++count;
  }
  const PointCloud sampled = clean(cloud, config);
  ASSERT_EQ(sampled.size(), leaves.size());
  EXPECT_LT(sampled.size(), cloud.size() / 2);
  std::size_t i = 0;
  for (const auto& [cell, leaf] : leaves)
    EXPECT_LT((sampled[i++].cast<double>() - leaf.first / leaf.second).norm(), 1e-6);
}

TEST(CloudFilter, ALeafTooSmallForTheCloudIsRefusedWithOneThatWorks) {
  CloudConfig config;
  config.outlier_removal = false;
  config.down_sampling = true;
  config.down_sampling_leaf = 1e-5;
  const PointCloud cloud = sheet_with_outliers(8, 1000, 10);
  try {
    clean(cloud, config);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("down_sampling_leaf"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    const auto number = message.rfind("at least ");
    ASSERT_NE(number, std::string::npos) << message;
    config.down_sampling_leaf = std::stod(message.substr(number + 9));
    EXPECT_LE(clean(cloud, config).size(), cloud.size());
  }
  config.down_sampling_leaf = 0.001;  // far from the origin even one leaf's number may overflow
  EXPECT_THROW(clean({{3e6f, 0.0f, 0.0f}}, config), std::invalid_argument);
}

TEST(CloudFilter, BadSettingsAreNamed) {
  const auto refused = [](CloudConfig config, const char* field) {
    try {
      clean({}, config);
      ADD_FAILURE() << field << " accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  CloudConfig config;
  config.outlier_neighbours = 0;
  refused(config, "outlier_neighbours");
  config = {};
  config.outlier_deviations = std::nan("");
  refused(config, "outlier_deviations");
  config = {};
  config.down_sampling_leaf = 0.0;
  refused(config, "down_sampling_leaf");
}

}  // namespace
}  // namespace nextview
