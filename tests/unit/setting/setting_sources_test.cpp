#include "core/setting/setting_sources.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

const SettingSources sources = {{"map.hit", {"map.hit", "a.toml:1", ""}},
                                {"map.hit_decay", {"--map.hit_decay", "", ""}},
                                {"map.miss", {"map.miss", "b.toml:2", ""}},
                                {"termination.views", {"--views (termination.views)", "", ""}},
                                {"seed", {"--seed", "", ""}}};

TEST(AsGiven, AFileIsNamedBeforeTheMessage) {
  EXPECT_EQ(as_given("map.hit must be over 0.5", sources), "a.toml:1: map.hit must be over 0.5");
  EXPECT_EQ(as_given("raise map.hit, or lower map.hit.", sources), "a.toml:1: raise map.hit, or lower map.hit.");
}

TEST(AsGiven, AnOptionIsNamedAsItWasWritten) {
  EXPECT_EQ(as_given("map.hit_decay must be from -5 to 5", sources), "--map.hit_decay must be from -5 to 5");
  EXPECT_EQ(as_given("lower termination.views", sources), "lower --views (termination.views)");
  EXPECT_EQ(as_given("seed must be at most 7", sources), "--seed must be at most 7");
}

TEST(AsGiven, OfSeveralEachIsNamed) {
  EXPECT_EQ(as_given("map.hit must be over map.miss, and map.miss under map.hit", sources),
            "a.toml:1: map.hit must be over map.miss (b.toml:2), and map.miss under map.hit");
  EXPECT_EQ(as_given("map.hit_decay needs map.miss", sources), "b.toml:2: --map.hit_decay needs map.miss");
}

TEST(AsGiven, WhatWasNamedBeforeIsNotNamedAgain) {
  for (const char* text : {"map.hit must be over 0.5", "lower termination.views",
                           "map.hit must be over map.miss, and map.miss under map.hit"}) {
    const std::string once = as_given(text, sources);
    EXPECT_EQ(as_given(once, sources), once);
  }
}

TEST(AsGiven, WhatOnlyLooksLikeAKeyStays) {
  for (const char* text : {"sensor.width must be", "map.hits", "my_map.hit", "map.hit.x", "--map.hit", "out/map.hit",
                           "map.hit/x", "every seed", "a.map.hit", ""})
    EXPECT_EQ(as_given(text, sources), text);
}

}  // namespace
}  // namespace nextview
