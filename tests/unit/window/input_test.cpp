#include "ui/window/input.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

TEST(InputQueue, APressAndItsReleaseAreInFramesOfTheirOwn) {
  InputQueue queue;
  queue.push(input::Button{PointerButton::left, true});
  queue.push(input::Button{PointerButton::left, false});
  const auto first = queue.take_frame(), second = queue.take_frame();
  ASSERT_EQ(first.size(), 1u);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_TRUE(std::get<input::Button>(first[0]).down);
  EXPECT_FALSE(std::get<input::Button>(second[0]).down);
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, MovesBeforeAPressBelongToIt) {
  InputQueue queue;
  queue.push(input::Move{1, 1});
  queue.push(input::Move{2, 2});
  queue.push(input::Button{PointerButton::left, true});
  queue.push(input::Move{3, 3});
  queue.push(input::Button{PointerButton::left, false});
  const auto first = queue.take_frame();
  ASSERT_EQ(first.size(), 3u);
  EXPECT_EQ(std::get<input::Move>(first[1]).x, 2);
  const auto second = queue.take_frame();
  ASSERT_EQ(second.size(), 2u) << "a move after a press must not change where the press was";
  EXPECT_EQ(std::get<input::Move>(second[0]).x, 3);
}

TEST(InputQueue, NothingIsLostOrReordered) {
  InputQueue queue;
  for (int i = 0; i < 100; ++i) {
    if (i % 3 == 0) {
      queue.push(input::Wheel{double(i)});
    } else {
      queue.push(input::Move{double(i), 0});
    }
  }
  int next = 0;
  while (!queue.empty()) {
    for (const InputEvent& event : queue.take_frame()) {
      const auto* wheel = std::get_if<input::Wheel>(&event);
      EXPECT_EQ(wheel ? wheel->steps : std::get<input::Move>(event).x, next++);
    }
  }
  EXPECT_EQ(next, 100);
  EXPECT_TRUE(queue.take_frame().empty());
}

}  // namespace
}  // namespace nextview
