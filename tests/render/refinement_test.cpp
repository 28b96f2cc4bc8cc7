#include <fmt/format.h>

#include "tests/render/gibbs_samples.hpp"
#include "tests/render/render_test.hpp"
#include "ui/figures/refinement_figure.hpp"
#include "ui/figures/sensor_model_figure.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

using samples::MapNumbers;
using samples::RefinedPlate;

std::string open_rows(const OpeningScore& score) { return fmt::format("{} of {}", score.open_rows, score.rows); }
std::string leaks(const OpeningScore& score) { return fmt::format("{} of {}", score.leaking_rows, score.control_rows); }

std::vector<RefinementNumber> numbers_of(const MapNumbers& before, const MapNumbers& after, double width) {
  const auto thousands = [](double value) { return fmt::format("{:.1f}", 1e-3 * value); };
  return {
      {"open rows of all slots and bores", open_rows(before.openings), open_rows(after.openings), ""},
      {fmt::format("open rows of the slot {:g} mm wide", 1e3 * width), open_rows(before.shown_opening),
       open_rows(after.shown_opening), ""},
      {"solid rows called open", leaks(before.openings), leaks(after.openings), ""},
      {"log loss near the surface", fmt::format("{:.3f}", before.near_surface.log_loss),
       fmt::format("{:.3f}", after.near_surface.log_loss), "nats per voxel"},
      {"… against voxel centres", fmt::format("{:.3f}", before.centres.log_loss),
       fmt::format("{:.3f}", after.centres.log_loss), "nats per voxel"},
      {"Brier score near the surface", fmt::format("{:.3f}", before.near_surface.brier),
       fmt::format("{:.3f}", after.near_surface.brier), ""},
      {"total entropy", thousands(before.entropy), thousands(after.entropy), "knats"},
      {"voxels measured, or informed", thousands(double(before.measured)), thousands(double(after.measured)),
       "thousand"},
  };
}

/// Says what came out, whichever map is the better one.
std::string caption_of(const MapNumbers& before, const MapNumbers& after) {
  const double loss_before = before.near_surface.log_loss, loss_after = after.near_surface.log_loss;
  return fmt::format(
      "Of {} rows through the plate's slots and bores the conventional map leaves {} open, the Gibbs map {}; its log "
      "loss near the surface is {}: {:.2f} instead of {:.2f} nats per voxel.",
      before.openings.rows, before.openings.open_rows, after.openings.open_rows,
      loss_after < loss_before ? "lower" : "not lower", loss_after, loss_before);
}

RefinementPicture picture_of(const RefinedPlate& plate) {
  RefinementPicture picture;
  picture.title = fmt::format("Gibbs refinement · slotted plate, across the slot {:g} mm wide",
                              1e3 * plate.part.openings.front().width);
  picture.remark = fmt::format("{} views from above · {} × {} pixels · {:g} mm noise · {:g} % outliers",
                               RefinedPlate::views, RefinedPlate::width, RefinedPlate::height,
                               1e3 * RefinedPlate::range_noise, 1e2 * RefinedPlate::outliers);
  picture.caption = caption_of(plate.conventional_numbers, plate.gibbs_numbers);
  picture.grid = plate.grid;
  picture.conventional = plate.conventional;
  picture.gibbs = plate.gibbs;
  picture.diagnostics = plate.diagnostics;
  picture.object = &plate.part.mesh;
  picture.openings = plate.part.openings;
  picture.numbers = numbers_of(plate.conventional_numbers, plate.gibbs_numbers, plate.part.openings.front().width);
  picture.numbers_note = fmt::format(
      "Near the surface: voxels at most {} from it that a noise-free ray visits. In truth a voxel is occupied if the "
      "surface touches it; against centres, if its centre is inside. Log loss, Brier score: lower is better.",
      band_width);
  return picture;
}

TEST(Figures, Refinement) {
  const RefinedPlate plate = samples::refined_plate();
  const PictureBound another_draw(0.03, 255,
                                  "the chains' draws hang on how the processor rounds; another seed changes 2.4 % of "
                                  "the pixels: the traces, the entropies, last digits");
  OffscreenTarget target(64, 48);
  expect_screenshot("refinement", draw_refinement_figure(target, picture_of(plate)), another_draw);
}

TEST(Figures, SensorModels) {
  OffscreenTarget target(64, 48);
  expect_screenshot("sensor_models", draw_sensor_model_figure(target, {}));
  EXPECT_EQ(target.width(), 64) << "it is not as it was";
}

TEST(SensorModelFigure, ShowsThePeaksOfASmallPartsModels) {
  SensorModelPicture small;
  small.model.sigma = 0.00005;
  small.resolution = 0.0002, small.surface = 0.0216, small.max_range = 0.036;
  OffscreenTarget target(64, 48);
  const Image image = draw_sensor_model_figure(target, small);
  const auto has_curve = [&](int x, int top, int bottom) {
    for (int y = top; y < bottom; ++y) {
      const std::uint8_t* pixel = &image.rgba[(std::size_t(y) * image.width + x) * 4];
      if (pixel[2] > pixel[0] + 80) return true;
    }
    return false;
  };
  EXPECT_TRUE(has_curve(230, 160, 340)) << "paper, in the middle of the voxel";
  EXPECT_TRUE(has_curve(230, 450, 632)) << "beam";
}

TEST(RefinementFigure, NeedsNoTruthAndNoChains) {
  RefinementPicture picture;
  picture.grid = {0.01, {0, 0, 0}, {30, 20, 10}};
  std::vector<Voxel> conventional(picture.grid.voxel_count()), gibbs = conventional;
  for (int x = 0; x < 30; ++x) gibbs[picture.grid.index({x, 7, 4})] = {0.9f, 0.3f, VoxelClass::occupied, true, 0};
  picture.conventional = conventional;
  picture.gibbs = gibbs;
  // Two layers hold all 30 voxels that differ: of equals the first.
  const GridSlice slice = default_slice(picture);
  EXPECT_EQ(slice.axis, 1);
  EXPECT_EQ(slice.index, 7);
  OffscreenTarget target(64, 48);
  EXPECT_EQ(draw_refinement_figure(target, picture).width, 1600);
  picture.gibbs = std::span(gibbs).first(7);
  EXPECT_THROW(draw_refinement_figure(target, picture), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
