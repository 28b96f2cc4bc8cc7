// Recorded data whose lengths are of another unit than they are read in.
#include "core/recording/doubted_unit.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

DescribedDataset images_of_scale(double scale) {
  DescribedDataset dataset{"scans", {}, {}, "scans/dataset.toml"};
  dataset.description.depth.scale = scale;
  return dataset;
}

DescribedDataset of(RecordingFormat format) {
  DescribedDataset dataset{"scans", {}, {}, {}};
  dataset.description.format = format;
  return dataset;
}

TEST(DoubtedUnit, WhatMayBeIsNotDoubted) {
  for (const double range : {0.01, 0.5, 40.0}) {
    EXPECT_EQ(doubted_unit(images_of_scale(0.001), 2.0 * range, range), "");
    EXPECT_EQ(doubted_unit(images_of_scale(0.001), 0.0, range), "") << "a camera that stands still";
  }
}

TEST(DoubtedUnit, DepthsAreMendedByTheirScale) {
  EXPECT_EQ(
      doubted_unit(images_of_scale(1.0), 2.0, 650.0),
      "the cameras see 650 m far on average: are their depths in millimetres, not metres? Then depth.scale = 0.001 in "
      "scans/dataset.toml mends it");
  EXPECT_EQ(
      doubted_unit(images_of_scale(0.001), 2.0, 0.00065),
      "the cameras see 0.65 mm far on average: are their depths in metres, not millimetres? Then depth.scale = 1 in "
      "scans/dataset.toml mends it");
  EXPECT_EQ(
      doubted_unit(images_of_scale(1.0), 900.0, 650.0),
      "the cameras see 650 m far on average: are their depths in millimetres, not metres? Then depth.scale = 0.001, "
      "with unit = \"mm\" for their poses, in scans/dataset.toml mends it");
}

TEST(DoubtedUnit, PosesAndCloudsAreMendedByTheirs) {
  EXPECT_EQ(
      doubted_unit(images_of_scale(0.001), 900.0, 0.65),
      "the cameras stand 900 m apart and see 650 mm far on average: are their poses in millimetres, not metres? Then "
      "unit = \"mm\" in scans/dataset.toml mends it");
  EXPECT_EQ(doubted_unit(of(RecordingFormat::clouds), 900.0, 650.0),
            "the cameras see 650 m far on average: are their points in millimetres, not metres? Then unit = \"mm\" in "
            "dataset.toml (nextview info scans --write-dataset writes it) mends it");
  EXPECT_EQ(
      doubted_unit(of(RecordingFormat::scan_graph), 900.0, 650.0),
      "the cameras see 650 m far on average: are their points in millimetres, not metres? Lengths of a scan-graph "
      "are taken in metres");
}

}  // namespace
}  // namespace nextview
