#include "core/source/scan_source.hpp"

#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"
#include "core/source/recorded_source.hpp"

namespace nextview {
namespace {

/// Gives no scan, for this reason.
class FailingSource : public ScanSource {
 public:
  explicit FailingSource(Failure failure) : failure_(std::move(failure)) {}
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View&, std::uint32_t, std::stop_token) override { return failure_; }

 private:
  SourceDescription description_;
  Failure failure_;
};

TEST(TakeScans, AStopIsAStopAndAFailureSaysWhy) {
  const std::vector<View> views(2);
  FailingSource stopped({Failure::cancelled, "asked to"}), broken({Failure::no_data, "the lens cap is on"});
  EXPECT_THROW(take_scans(stopped, views, nullptr, {}, {}), Stopped);
  try {
    take_scans(broken, views, nullptr, {}, {});
    FAIL() << "it has no scan";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the lens cap is on");
  }
}

TEST(RecordedSource, HasItsFramesAndNoOthers) {
  const std::vector<RecordedScan> scans(2);
  RecordedSource source(scans, 1.5);
  const auto is_there = [&](std::optional<std::uint32_t> frame) {
    View view;
    if (frame) view.frame = *frame;
    const Result<Capture> capture = source.capture(view, 1, {});
    const auto* failure = std::get_if<Failure>(&capture);
    EXPECT_TRUE(!failure || failure->kind == Failure::no_data);
    return !failure;
  };
  EXPECT_TRUE(is_there(0) && is_there(1));
  EXPECT_FALSE(is_there(2)) << "there is no third one";
  EXPECT_FALSE(is_there({})) << "a pose of one's own is no frame";
}

}  // namespace
}  // namespace nextview
