// What a demo shows by its own time: motions, texts that fade, waits.
#include "ui/commands/presentation.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

/// 6 t^5 - 15 t^4 + 10 t^3, whose values at these shares are exact.
TEST(Eased, GoesFromRestToRest) {
  EXPECT_EQ(eased(0.0), 0.0);
  EXPECT_EQ(eased(0.25), 0.103515625);
  EXPECT_EQ(eased(0.5), 0.5);
  EXPECT_EQ(eased(0.75), 0.896484375);
  EXPECT_EQ(eased(1.0), 1.0);
  EXPECT_EQ(eased(-3.0), 0.0) << "it has not begun";
  EXPECT_EQ(eased(1.5), 1.0) << "it is there";
  for (double share = 0.0; share < 1.0; share += 0.01) {
    EXPECT_LT(eased(share), eased(share + 0.01)) << "never back";
    EXPECT_NEAR(eased(share) + eased(1.0 - share), 1.0, 1e-12) << "its end is as its begin";
  }
  EXPECT_LT(eased(0.01) / 0.01, 0.01) << "at rest";
}

/// A text takes 0.35 s to come, and as long to go.
TEST(ShownText, FadesInAndOut) {
  ShownText text{"a", "", 0.0, 2.0};
  const auto opacity_at = [&](double age) {
    text.age = age;
    return text.opacity();
  };
  EXPECT_EQ(opacity_at(-1.0), 0.0) << "it waits for the one before";
  EXPECT_EQ(opacity_at(0.0), 0.0);
  EXPECT_NEAR(opacity_at(0.175), 0.5, 1e-12);
  EXPECT_EQ(opacity_at(1.0), 1.0);
  EXPECT_NEAR(opacity_at(1.825), 0.5, 1e-12);
  EXPECT_EQ(opacity_at(2.0), 0.0);
  EXPECT_EQ(opacity_at(3.0), 0.0);
  text.length.reset();
  EXPECT_EQ(opacity_at(1000.0), 1.0) << "until the next one";
}

TEST(ShownText, HasTimeLeftUntilItIsOver) {
  ShownText text{"a", "", 0.5, 2.0};
  EXPECT_EQ(text.left(), 1.5);
  EXPECT_FALSE(text.is_over());
  text.age = 2.0;
  EXPECT_EQ(text.left(), 0.0);
  EXPECT_TRUE(text.is_over());
  text.age = 3.0;
  EXPECT_EQ(text.left(), 0.0);
  text.length.reset();
  EXPECT_EQ(text.left(), 0.0) << "it has no end";
  EXPECT_FALSE(text.is_over());
}

TEST(Presentation, ACaptionComesOnceTheOneBeforeHasFaded) {
  Presentation p;
  p.show_caption("one", {});
  EXPECT_FALSE(p.leaving_caption);
  EXPECT_EQ(p.caption.value().age, 0.0) << "there is none before";
  p.pass(1.0, false);
  EXPECT_EQ(p.caption->opacity(), 1.0);
  p.show_caption("two", 2.0);
  EXPECT_EQ(p.leaving_caption.value().opacity(), 1.0);
  p.pass(0.175, false);
  EXPECT_NEAR(p.leaving_caption.value().opacity(), 0.5, 1e-12);
  EXPECT_EQ(p.caption.value().opacity(), 0.0);
  p.pass(0.35, false);
  EXPECT_FALSE(p.leaving_caption) << "it has gone";
  EXPECT_NEAR(p.caption.value().opacity(), 0.5, 1e-12);
  p.show_caption("", {});
  EXPECT_FALSE(p.caption);
  EXPECT_EQ(p.leaving_caption.value().text, "two");
  p.pass(0.5, false);
  EXPECT_FALSE(p.leaving_caption);
  EXPECT_FALSE(p.is_moving());
}

TEST(Presentation, ACaptionThatNobodySawYetIsReplacedAtOnce) {
  Presentation p;
  p.show_caption("one", {});
  p.show_caption("two", {});
  EXPECT_FALSE(p.leaving_caption);
  EXPECT_EQ(p.caption.value().text, "two");
  EXPECT_EQ(p.caption->age, 0.0);
}

TEST(Presentation, ACaptionThatWasGoingAnywayGoesNoLater) {
  Presentation p;
  p.show_caption("one", 1.0);
  p.pass(0.9, false);
  p.show_caption("two", {});
  EXPECT_NEAR(p.leaving_caption.value().left(), 0.1, 1e-12);
}

TEST(Presentation, ADemosFirstTitleIsThereFromTheFirstFrame) {
  Presentation p;
  p.show_title("A", "b", 2.0);
  EXPECT_EQ(p.title.value().opacity(), 1.0);
  EXPECT_EQ(p.title->left(), 2.0);
  p.pass(1.0, false);
  p.show_title("C", "", 2.0);
  EXPECT_EQ(p.title.value().opacity(), 0.0) << "later ones fade in";
  EXPECT_EQ(p.title->left(), 2.0);
  p.pass(2.0, false);
  EXPECT_FALSE(p.title);
}

TEST(Presentation, MovesWhileSomethingOfItChanges) {
  Presentation p;
  EXPECT_FALSE(p.is_moving());
  p.show_caption("one", {});
  EXPECT_TRUE(p.is_moving()) << "it fades in";
  p.pass(0.5, false);
  EXPECT_FALSE(p.is_moving()) << "it stays as it is";
  p.wait(1.0);
  EXPECT_TRUE(p.holds() && p.is_moving());
  p.hold = 0.0;
  p.flights.push_back({.seconds = 3.0, .elapsed = 1.0});
  EXPECT_TRUE(p.is_moving());
  EXPECT_EQ(p.left(), 2.0);
  p.flights.push_back({.seconds = 1.0});
  EXPECT_EQ(p.left(), 3.0) << "one after the other";
  p.flights.clear();
  p.highlight = ShownText{"gibbs", "", 0.0, 4.0};
  EXPECT_EQ(p.left(), 4.0);
  EXPECT_TRUE(p.is_moving());
}

TEST(Presentation, TimePassesOnlyWhileTheScriptWaits) {
  Presentation p;
  EXPECT_EQ(p.pass(0.5, true), 0.0) << "it does not wait";
  p.wait(1.0);
  EXPECT_EQ(p.pass(0.25, true), 0.25);
  EXPECT_EQ(p.hold, 0.75);
  EXPECT_EQ(p.pass(1.0, true), 0.75);
  EXPECT_FALSE(p.holds());
  EXPECT_EQ(p.time, 1.0);
  EXPECT_EQ(p.due, 0.25) << "the rest is for the next wait";
  p.paused = true;
  EXPECT_EQ(p.pass(5.0, true), 0.0);
  EXPECT_EQ(p.pass(5.0, false), 0.0);
  p.paused = false;
  EXPECT_EQ(p.pass(5.0, false), 5.0) << "without a script it just passes";
  EXPECT_EQ(p.time, 6.0);
}

}  // namespace
}  // namespace nextview
