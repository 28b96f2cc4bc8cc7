#pragma once
#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <string>

namespace nextview {

/// Runs a test on one instruction set after the other of those that this processor has.
class OnInstructionSet : public ::testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override { choose(GetParam()); }
  void TearDown() override { choose(0); }

 private:
  static void choose(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();  // chosen anew by the next call
  }
};
inline auto instruction_sets() { return ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()); }
inline std::string instruction_set_name(const ::testing::TestParamInfo<std::int64_t>& target) {
  return hwy::TargetName(target.param);
}

}  // namespace nextview
