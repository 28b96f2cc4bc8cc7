// What the panel of the layers shows and switches.
#include <gmock/gmock.h>

#include "tests/unit/panels/made_scan.hpp"
#include "tests/unit/panels/seen.hpp"
#include "ui/commands/layer_commands.hpp"
#include "ui/layers/voxel_palette.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Layers : public testing::Test {
 protected:
  Layers() {
    desk_.snapshot = scan_;
    desk_.window.bring_to_front("layers");
  }
  std::string panel() {
    desk_.frames();
    return read("Layers");
  }
  LayerChoice& layers() { return desk_.window.layers; }

  std::shared_ptr<SessionSnapshot> scan_ = made_scan();
  Desk desk_{1280, 960};
};

TEST_F(Layers, TheSliceOfASmallPartIsInTenthsOfAMillimetre) {
  scan_->grid.resolution = 0.0005;
  layers().voxels.slice = Slice{1, 0.0012, 0.0013};
  EXPECT_THAT(panel(), testing::ContainsRegex("at \\[mm\\] 1\\.[23]"));
}

TEST_F(Layers, TheSliceIsInMillimetresAndMovesInMetres) {
  layers().voxels.slice = Slice{1, 0.05, 0.25};
  EXPECT_THAT(panel(), HasSubstr("at [mm] 150"));
  const auto all = seen_texts();
  const SeenText* value = find_text(all, "150", "Layers");
  ASSERT_NE(value, nullptr);
  desk_.click(value->from.x + 30, value->middle());
  const auto calls = desk_.frames();
  ASSERT_FALSE(calls.empty());
  EXPECT_EQ(calls.back().command->name, "slice-at");
  const double at = std::stod(calls.back().values().at(0));
  EXPECT_TRUE(at > 0.151 && at < scan_->grid.upper().y()) << at << " m";
}

TEST_F(Layers, ThresholdsShowTheirValuesWhereTheyMatter) {
  layers().voxels.unknown = true;
  layers().voxels.unknown_from = 0.35;
  layers().voxels.entropy_from = 0.45;
  EXPECT_THAT(panel(), HasSubstr("p from 0.35"));
  EXPECT_THAT(panel(), Not(HasSubstr("0.45 nats")));
  layers().voxels.uncertain = true;
  EXPECT_THAT(panel(), HasSubstr("from 0.45 nats"));
}

TEST_F(Layers, UnknownVoxelsHaveOneNameInPanelAndLegend) {
  EXPECT_THAT(panel(), HasSubstr("unknown"));
  const Legend legend = VoxelPalette(VoxelColouring::by_class).legend(layers().voxels, false);
  ASSERT_EQ(legend.swatches.size(), 2u);
  EXPECT_THAT(legend.swatches[1].name, HasSubstr("measured but unknown"));
  const std::vector<SeenText> texts = seen_texts();
  const SeenText* const line = find_text(texts, "unknown", "Layers");
  ASSERT_NE(line, nullptr);
  desk_.move(line->from.x + 5, line->middle());
  for (int frame = 0; frame < 120; ++frame) desk_.frame();
  EXPECT_THAT(read_tooltip(), AllOf(HasSubstr("too few rays hit them"), HasSubstr("More views")));
}

TEST_F(Layers, EachLineSwitchesItsOwn) {
  desk_.frames();
  for (const auto& [label, command] : {std::pair{"Object", "toggle-object"},
                                       {"Missed surface", "toggle-missed"},
                                       {"Reconstructed surface", "toggle-surface"},
                                       {"Point cloud", "toggle-cloud"},
                                       {"Octree", "toggle-octree"},
                                       {"occupied", "toggle-occupied"},
                                       {"free", "toggle-free"},
                                       {"uncertain only", "toggle-uncertain"},
                                       {"Candidate views", "toggle-views"},
                                       {"Rays", "toggle-rays"},
                                       {"Region of interest", "toggle-region"},
                                       {"Lock colour ranges", "lock-ranges"},
                                       {"wire", "object-style wire"}})
    EXPECT_EQ(text_of(click_on(desk_, label, "Layers")), command) << label;
  EXPECT_EQ(text_of(click_on(desk_, "y", "Layers")), "slice-axis y");
  EXPECT_EQ(text_of(click_on(desk_, "all", "Layers")), "slice-axis none");
}

TEST_F(Layers, KeysStandAtTheRightBesideWhatTheySwitch) {
  desk_.frames();
  const auto all = seen_texts();
  std::vector<float> ends;
  for (const auto& [label, command] : {std::pair{"Object", &command::toggle_object},
                                       {"Point cloud", &command::toggle_cloud},
                                       {"Octree", &command::toggle_octree},
                                       {"Candidate views", &command::toggle_views},
                                       {"Rays", &command::toggle_rays}}) {
    const std::string keys = command->keys();
    ASSERT_FALSE(keys.empty()) << label;
    const SeenText* name = find_text(all, label, "Layers");
    ASSERT_NE(name, nullptr) << label;
    const auto key = std::ranges::find_if(all, [&](const SeenText& t) {
      return t.window == "Layers" && t.text == keys && std::abs(t.middle() - name->middle()) < 3;
    });
    ASSERT_NE(key, all.end()) << label << ": " << keys << " is not seen";
    EXPECT_GT(key->from.x, name->to.x);
    ends.push_back(key->to.x);
  }
  const ImGuiWindow* panel = ImGui::FindWindowByName("Layers");
  for (const float end : ends) {
    EXPECT_NEAR(end, ends.front(), 1.0f) << "one beneath the other";
    EXPECT_TRUE(end < panel->InnerClipRect.Max.x && end > panel->InnerClipRect.Max.x - 30) << end;
  }
}

TEST_F(Layers, ASectionIsMovedAndTurnedOverOnceThereIsOne) {
  EXPECT_THAT(panel(), Not(HasSubstr("Turn over")));
  EXPECT_THAT(panel(), Not(HasSubstr("at [mm]")));
  layers().section = Section{2, 0.0123, false};
  EXPECT_THAT(panel(), HasSubstr("at [mm] 12.3"));
  EXPECT_EQ(text_of(click_on(desk_, "Turn over", "Layers")), "flip-section");
  const auto all = seen_texts();
  const SeenText* value = find_text(all, "12.3", "Layers");
  ASSERT_NE(value, nullptr);
  desk_.click(value->from.x + 40, value->middle());
  const auto calls = desk_.frames();
  ASSERT_FALSE(calls.empty());
  EXPECT_EQ(calls.back().command->name, "section-at");
  const double at = std::stod(calls.back().values().at(0)), top = scan_->mesh->bounding_box().max().z();
  EXPECT_TRUE(at > 0.0133 && at <= top) << at << " m of " << top;
  desk_.snapshot = std::make_shared<SessionSnapshot>();
  EXPECT_THAT(panel(), Not(HasSubstr("Turn over"))) << "nothing is there to be cut";
}

TEST_F(Layers, ListsNameWhatTheyChoose) {
  desk_.frames();
  for (const auto& [shown, entry, command] : {std::tuple{"conventional map", "Gibbs map", "voxel-map gibbs"},
                                              {"class", "entropy", "voxel-colour entropy"},
                                              {"class", "error", "voxel-colour error"},
                                              {"one colour", "height", "cloud-colour height"},
                                              {"one colour", "distance to truth", "cloud-colour distance"}}) {
    click_on(desk_, shown, "Layers");
    EXPECT_EQ(text_of(click_on(desk_, entry, "##Combo_00")), command);
  }
  layers().map = MapChoice::gibbs;
  layers().colouring = VoxelColouring::by_difference;
  layers().cloud_colouring = CloudColouring::by_view;
  scan_->gibbs = std::make_shared<const GibbsMap>();
  EXPECT_THAT(panel(), HasSubstr("Coloured by view"));
  EXPECT_THAT(panel(), HasSubstr("Of the Gibbs map Coloured by change by Gibbs"));
}

TEST_F(Layers, NameTheColoursThatAreThereWithoutATruth) {
  layers().cloud_colouring = CloudColouring::by_distance;
  EXPECT_THAT(panel(), HasSubstr("Coloured by distance to truth"));
  const auto truth = std::exchange(scan_->truth, nullptr);
  EXPECT_THAT(panel(), HasSubstr("Coloured by one colour"));
  scan_->truth = truth;
  EXPECT_THAT(panel(), HasSubstr("Coloured by distance to truth")) << "it comes back";
}

}  // namespace
}  // namespace nextview
