#include "ui/workbench/answer_thread.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>

namespace nextview {
namespace {

template <class Thread>
void wait_until_answered(const Thread& thread) {
  while (thread.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(AnswerThread, WhatThrowsIsNoAnswerAndTheThreadGoesOn) {
  std::atomic<int> news = 0;
  AnswerThread<int, int> thread(
      [](int question, const std::stop_token&) {
        if (question == 2) throw std::bad_alloc();
        return std::make_shared<const int>(10 * question);
      },
      [&] { ++news; });
  for (const auto& [question, answer] : {std::pair(1, 10), {2, 10}, {3, 30}}) {
    thread.ask(question);
    wait_until_answered(thread);
    EXPECT_EQ(*thread.answer(), answer) << question;
  }
  while (news < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // who waits for it hears of each
}

}  // namespace
}  // namespace nextview
