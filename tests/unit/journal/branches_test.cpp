#include "core/journal/branches.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/journal/journal.hpp"
#include "core/journal/journal_records.hpp"

namespace nextview {
namespace {

std::vector<std::string> names(const Branches& branches) {
  std::vector<std::string> result;
  for (const Branch& branch : branches.all) result.push_back(branch.name);
  return result;
}

TEST(Branches, AStepFromTheTipGoesOnAndFromElsewhereBeginsOne) {
  Branches b;
  EXPECT_FALSE(b.add_step(1, 0));
  EXPECT_FALSE(b.add_step(2, 1));
  EXPECT_TRUE(b.add_step(3, 1));
  EXPECT_THAT(names(b), testing::ElementsAre("main", "branch 2"));
  EXPECT_EQ(b.all[0].tip, 2u);
  EXPECT_EQ(b.current().tip, 3u);
}

TEST(Branches, NamesAreLinesAndUnique) {
  Branches b;
  b.begin("what if", 0);
  EXPECT_THROW(b.begin("what if", 0), std::invalid_argument);
  for (const char* bad : {"", " a", "a ", "a\nb", "\x7f"}) EXPECT_THROW(b.begin(bad, 0), std::invalid_argument) << bad;
  EXPECT_THROW(b.begin(std::string(61, 'a'), 0), std::invalid_argument);
  b.rename("what if", "what if");
  b.rename("main", "first");
  EXPECT_THROW(b.rename("main", "x"), std::invalid_argument);
  EXPECT_THROW(b.rename("first", "what if"), std::invalid_argument);
  EXPECT_THROW(b.remove("what if"), std::invalid_argument) << "it is the current one";
  b.remove("first");
  EXPECT_EQ(b.on, 0u);
  EXPECT_EQ(b.current().name, "what if");
}

/// Steps 1-2-3, and 4 from 1.
bool leads_through(std::uint32_t tip, std::uint32_t step) {
  const std::vector<std::uint32_t> after = {0, 0, 1, 2, 1};
  while (tip > step) tip = after.at(tip);
  return tip == step;
}

TEST(Branches, GoingBackKeepsWhatHasStepsOfItsOwn) {
  Branches b;
  b.add_step(1, 0);
  const Branches then = b;
  b.add_step(2, 1);
  b.add_step(3, 2);
  b.add_step(4, 1);
  const Branches back = b.back_to(then, leads_through);
  EXPECT_THAT(names(back), testing::ElementsAre("main", "branch 2"));
  EXPECT_EQ(back.current().name, "main");
  EXPECT_EQ(back.current().tip, 3u) << "its later steps are ahead of it";
}

TEST(Branches, GoingBackUndoesWhatHasNone) {
  Branches b;
  b.add_step(1, 0);
  const Branches then = b;
  b.begin("empty", 1);
  b.rename("main", "first");
  EXPECT_THAT(names(b.back_to(then, leads_through)), testing::ElementsAre("main"));
  EXPECT_THAT(names(then.back_to(b, leads_through)), testing::ElementsAre("first", "empty")) << "and forward again";
  b.remove("first");
  b.begin("another", 1);
  EXPECT_THAT(names(b.back_to(then, leads_through)), testing::ElementsAre("main")) << "a removed one comes back";
}

TEST(Branches, ARemovedOneWithStepsGoesAndComesBack) {
  Branches b;
  b.add_step(1, 0);
  b.add_step(2, 1);
  b.add_step(3, 1);
  b.on = 0;
  Branches without = b;
  without.remove("branch 2");
  EXPECT_THAT(names(without.back_to(b, leads_through)), testing::ElementsAre("main", "branch 2"));
  EXPECT_THAT(names(b.back_to(without, leads_through)), testing::ElementsAre("main")) << "and is removed again";
}

TEST(Branches, ARecordSaysThem) {
  Journal journal;
  read_record(beginning_record({"box"}, ""), journal);
  EXPECT_EQ(journal.branches, Branches());
  JournalStep step;
  for (const auto& [number, after] : std::vector<std::pair<int, int>>{{1, 0}, {2, 1}, {3, 1}}) {
    step.number = std::uint32_t(number);
    step.after = std::uint32_t(after);
    step.scan = "000" + std::to_string(number) + ".npy";
    step.camera = {2, 2, 1, 1, 1, 1};
    read_record(step_record(step), journal);
  }
  EXPECT_THAT(names(journal.branches), testing::ElementsAre("main", "branch 2"));
  Branches named = journal.branches;
  named.rename("branch 2", "\"from\\ below\"");
  named.on = 0;
  Journal again = journal;
  read_record(branches_record(named), again);
  EXPECT_EQ(again.branches.all, named.all);
  EXPECT_EQ(again.branches.on, 0u);
  for (const char* bad : {R"({"record":"branches","branches":[],"on":0})",
                          R"({"record":"branches","branches":[{"name":"a","tip":9}],"on":0})",
                          R"({"record":"branches","branches":[{"name":"a","tip":1}],"on":1})",
                          R"({"record":"branches","branches":[{"name":"a","tip":1},{"name":"a","tip":1}],"on":0})"})
    EXPECT_ANY_THROW(read_record(bad, again)) << bad;
  EXPECT_EQ(again.branches.all, named.all) << "what is no record changes nothing";
  read_record(outcome_record(2, {{"coverage", 0.25}, {"gain", std::nan("")}}), again);
  EXPECT_EQ(again.steps.at(2).outcome.at("coverage"), 0.25);
  EXPECT_TRUE(std::isnan(again.steps.at(2).outcome.at("gain")));
}

}  // namespace
}  // namespace nextview
