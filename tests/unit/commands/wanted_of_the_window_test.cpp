// What commands ask the window for: pictures, measurements, cameras; and what scripts assert.
#include <gmock/gmock.h>

#include "tests/unit/workbench/inspected_scan.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Of = PictureRequest::Of;

/// A window on a session that has an object, and a view where one is asked for.
class WantedOfTheWindow : public testing::Test {
 protected:
  WantedOfTheWindow() { session_.session = 1; }
  std::string error_of(const std::string& line) {
    CommandTarget target{worker_, window_, session_, progress_};
    try {
      execute(parse_call(line), target);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  }
  PictureRequest picture(const std::string& line) {
    window_.picture.reset();
    EXPECT_EQ(error_of(line), "no error") << line;
    return window_.picture.value();
  }

  SessionWorker worker_;
  WindowState window_;
  SessionSnapshot session_;
  WorkerProgress progress_;
};

TEST_F(WantedOfTheWindow, PicturesAreOfWhatTheirNameSays) {
  session_.records.resize(1);
  EXPECT_EQ(picture("save-picture a.png"), (PictureRequest{Of::window, "a.png"}));
  EXPECT_EQ(picture("save-picture a.png 640x480"), (PictureRequest{Of::window, "a.png", PictureSize{640, 480}}));
  EXPECT_EQ(picture("export-picture a.png"), (PictureRequest{Of::scene, "a.png"}));
  EXPECT_EQ(picture("export-picture a.png 640x480 transparent"),
            (PictureRequest{Of::scene, "a.png", PictureSize{640, 480}, true}));
  EXPECT_EQ(picture("export-picture a.png 640x480 opaque"),
            (PictureRequest{Of::scene, "a.png", PictureSize{640, 480}}));
  EXPECT_EQ(picture("export-curves a.svg"), (PictureRequest{Of::curves, "a.svg"}));
  EXPECT_EQ(picture("export-turntable frames"), (PictureRequest{Of::turntable, "frames", {}, false, 36}));
  EXPECT_THAT(error_of("save-picture a.png"), HasSubstr("a turntable is being drawn"));
  EXPECT_THAT(error_of("export-curves a.svg"), HasSubstr("a turntable is being drawn"));
  EXPECT_EQ(window_.picture->file, "frames") << "it goes on";
  window_.picture.reset();
  EXPECT_EQ(picture("export-turntable frames 12 320x200 transparent"),
            (PictureRequest{Of::turntable, "frames", PictureSize{320, 200}, true, 12}));
  window_.picture.reset();
  EXPECT_THAT(error_of("export-picture a.png 15x15"), StartsWith("export-picture: SIZE: takes WIDTHxHEIGHT"));
  EXPECT_THAT(error_of("save-picture a.png wide"), StartsWith("save-picture: SIZE: takes WIDTHxHEIGHT"));
  EXPECT_THAT(error_of("export-picture a.gif"), HasSubstr("a.gif"));
  EXPECT_THAT(error_of("export-turntable frames 1"), HasSubstr("from 2 to 3600"));
  EXPECT_FALSE(window_.picture) << "what is refused is not drawn";
  session_.records.clear();
  EXPECT_THAT(error_of("export-picture a.png"), StartsWith("export-picture: ")) << "there is nothing to see yet";
}

TEST_F(WantedOfTheWindow, FramesTheObjectUnlessSomethingElseIsSaid) {
  for (const auto& [line, what] : {std::pair("frame", Framed::object),
                                   {"frame object", Framed::object},
                                   {"frame all", Framed::all},
                                   {"frame region", Framed::region}}) {
    window_.camera_motions.clear();
    EXPECT_EQ(error_of(line), "no error");
    EXPECT_EQ(std::get<camera_motion::Frame>(window_.camera_motions.at(0)).what, what) << line;
  }
}

TEST_F(WantedOfTheWindow, GoesToACameraThatWasKept) {
  EXPECT_EQ(error_of("go-to-camera left"), "go-to-camera: no camera is kept yet (keep-camera)");
  EXPECT_EQ(error_of("remove-camera left"), "remove-camera: no camera is kept yet (keep-camera)");
  const Pose left = look_at(Vector3(-1, 0, 0.2), Vector3::Zero()), right = look_at(Vector3(1, 0, 0.2), Vector3::Zero());
  session_.cameras = std::make_shared<const std::vector<CameraBookmark>>(
      std::vector<CameraBookmark>{{"left", left}, {"right", right}});
  EXPECT_EQ(error_of("go-to-camera right"), "no error");
  EXPECT_EQ(std::get<camera_motion::GoTo>(window_.camera_motions.at(0)).T_world_camera.matrix(), right.matrix());
  EXPECT_THAT(error_of("go-to-camera above"), HasSubstr("above"));
  EXPECT_EQ(window_.camera_motions.size(), 1u);
}

TEST_F(WantedOfTheWindow, MeasuresPointByPointAndBeginsAgain) {
  InspectedScan scan(small_scan());
  session_ = scan.now();
  EXPECT_EQ(error_of("measure-point 0 0 0"), "measure-point: nothing is measured (measure)");
  EXPECT_EQ(error_of("measure"), "no error");
  EXPECT_EQ(window_.measurement.value().kind, MeasureKind::distance) << "unless it is said";
  EXPECT_EQ(error_of("measure-point 0.1 0.2 0.3"), "no error");
  EXPECT_EQ(window_.measurement->points, (std::vector<Vector3>{{0.1, 0.2, 0.3}}));
  const std::size_t before = worker_.log().entries()->size();
  EXPECT_EQ(error_of("measure-point 0.1 0.2 0.8"), "no error");
  EXPECT_TRUE(window_.measurement->complete());
  ASSERT_EQ(worker_.log().entries()->size(), before + 1) << "it is said once it is known";
  EXPECT_THAT(worker_.log().entries()->back().text, StartsWith("Distance 500 mm"));
  EXPECT_EQ(error_of("measure-point 1 2 3"), "no error");
  EXPECT_EQ(window_.measurement->points, (std::vector<Vector3>{{1, 2, 3}})) << "the next one begins";
  EXPECT_EQ(error_of("measure bore"), "no error");
  EXPECT_EQ(window_.measurement->kind, MeasureKind::bore);
  EXPECT_TRUE(window_.measurement->points.empty());
  EXPECT_EQ(error_of("measure plane"), "no error");
  EXPECT_EQ(window_.measurement->kind, MeasureKind::plane);
  EXPECT_EQ(error_of("measure"), "no error");
  EXPECT_EQ(window_.measurement.value().kind, MeasureKind::bore) << "again, before a click: the next kind";
  EXPECT_EQ(error_of("measure"), "no error");
  EXPECT_FALSE(window_.measurement) << "after the last kind: no more";
  EXPECT_EQ(error_of("measure"), "no error");
  EXPECT_EQ(error_of("measure-point 1 2 3"), "no error");
  EXPECT_EQ(error_of("measure"), "no error");
  EXPECT_FALSE(window_.measurement) << "after a click: no more";
  for (const char* line : {"measure plane", "measure-point 1 2 3", "measure-point 2 2 3", "measure-point 1 3 3",
                           "measure-point 1 2 4", "measure"})
    EXPECT_EQ(error_of(line), "no error") << line;
  EXPECT_EQ(window_.measurement, (Measurement{MeasureKind::plane, {}})) << "once it is measured: another";
}

TEST_F(WantedOfTheWindow, AssertionsHoldOnTheirSideOfANumberAndAtIt) {
  session_.records.resize(3);
  const auto holds = [&](const std::string& relation, int wanted) {
    return error_of("assert views " + relation + " " + std::to_string(wanted)) == "no error";
  };
  for (const int wanted : {2, 3, 4}) {
    EXPECT_EQ(holds("=", wanted), wanted == 3) << wanted;
    EXPECT_EQ(holds("<", wanted), wanted == 4) << wanted;
    EXPECT_EQ(holds("<=", wanted), wanted >= 3) << wanted;
    EXPECT_EQ(holds(">", wanted), wanted == 2) << wanted;
    EXPECT_EQ(holds(">=", wanted), wanted <= 3) << wanted;
  }
}

TEST_F(WantedOfTheWindow, AssertionsAreOfTheLastView) {
  EXPECT_EQ(error_of("assert entropy > 0"), "no view was taken");
  EXPECT_EQ(error_of("assert views 0"), "no error");
  session_.records.resize(2);
  session_.records[0].entropy = 5, session_.records[1].entropy = 3;
  session_.records[0].surface_left = 0.5;
  EXPECT_EQ(error_of("assert entropy 3"), "no error");
  EXPECT_THAT(error_of("assert surface-left 0.5"), HasSubstr("surface-left is not known here"));
  session_.records[1].surface_left = 0.25;
  EXPECT_EQ(error_of("assert surface-left 0.25"), "no error");
  EXPECT_EQ(error_of("assert gibbs-views 0"), "no error");
}

TEST_F(WantedOfTheWindow, ACaptionSaysTheFirstSentenceOfTheReason) {
  EXPECT_EQ(error_of("caption \"now: {reason}!\""), "no error");
  EXPECT_EQ(window_.presentation.caption.value().text, "now: !") << "no view was chosen yet";
  session_.records.resize(1);
  session_.records[0].ranking.reason = "It sees most. Another one is farther.";
  EXPECT_EQ(error_of("caption \"now: {reason}!\" 2"), "no error");
  EXPECT_EQ(window_.presentation.caption.value().text, "now: It sees most!");
  EXPECT_EQ(window_.presentation.caption->length, 2.0);
}

TEST_F(WantedOfTheWindow, FlightsGoWhereTheyAreSent) {
  EXPECT_EQ(error_of("orbit 90 3"), "no error");
  EXPECT_EQ(error_of("orbit -45 2 10"), "no error");
  EXPECT_EQ(error_of("fly-to 10 20 4"), "no error");
  EXPECT_EQ(error_of("fly-to 10 20 4 1.5 0.1 0.2 0.3"), "no error");
  const auto& flights = window_.presentation.flights;
  ASSERT_EQ(flights.size(), 4u);
  EXPECT_TRUE(flights[0].relative && flights[1].relative);
  EXPECT_FALSE(flights[2].relative || flights[3].relative);
  EXPECT_EQ(flights[0].azimuth, 90);
  EXPECT_EQ(flights[0].elevation, 0);
  EXPECT_EQ(flights[0].seconds, 3);
  EXPECT_EQ(flights[1].elevation, 10);
  EXPECT_EQ(flights[2].azimuth, 10);
  EXPECT_EQ(flights[2].elevation, 20);
  EXPECT_EQ(flights[2].seconds, 4);
  EXPECT_EQ(flights[2].zoom, 1) << "as the object is framed";
  EXPECT_FALSE(flights[2].focus);
  EXPECT_EQ(flights[3].zoom, 1.5);
  EXPECT_EQ(flights[3].focus.value(), Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(error_of("fly-to 10 20 4 1.5 0.1"), "fly-to: a point has three numbers");
  EXPECT_EQ(error_of("fly-to 10 20 4 1.5 0.1 0.2"), "fly-to: a point has three numbers");
  EXPECT_EQ(flights.size(), 4u);
}

}  // namespace
}  // namespace nextview
