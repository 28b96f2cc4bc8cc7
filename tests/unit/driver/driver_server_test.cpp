#include "core/driver/driver_server.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "core/driver/driver_answer.hpp"
#include "core/file/npy_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

/// Two pixels: the seed and the step.
class NumberSource : public ScanSource {
 public:
  explicit NumberSource(std::uint64_t seed) : seed_(seed) {}
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) override {
    if (step == 7) return Failure{Failure::no_data, "the lens cap is on"};
    while (step == 8)
      if (stop.stop_requested()) return Failure{Failure::cancelled, "whatever"};
    return Capture{DepthImage{description_.camera, {float(seed_), float(step)}}, view.T_world_camera, 1.5};
  }

 private:
  std::uint64_t seed_;
  SourceDescription description_{{2, 1, 1.0, 1.0, 0.5, 0.0}};
};

/// What is answered to these lines.
std::vector<std::string> answers(const std::string& requests) {
  FreeFlyingCamera robot(Pose::Identity());
  const auto source = [](std::uint64_t seed) { return std::make_unique<NumberSource>(seed); };
  const ServedScanner scanner{"test", {"stop"}, source(1)->describe(),      "", robot,
                              source, 5,        {{"sensor.dropout", "0.1"}}};
  std::istringstream in(requests);
  std::ostringstream out;
  serve(scanner, in, out);
  std::vector<std::string> lines;
  std::istringstream written(out.str());
  for (std::string line; std::getline(written, line);) lines.push_back(line);
  return lines;
}

const std::string pose = "[1,0,0,0.1,0,1,0,0.2,0,0,1,2.0,0,0,0,1]";

TEST(DriverServer, AnswersEachRequest) {
  const TemporaryFolder folder;
  const auto lines = answers(
      "{\"id\":1,\"request\":\"hello\",\"protocol\":1}\n"
      "{\"id\":2,\"request\":\"reach\",\"from\":" +
      pose + ",\"poses\":[" + pose +
      "]}\n"
      "{\"id\":3,\"request\":\"move\",\"pose\":" +
      pose +
      "}\n"
      "{\"id\":4,\"request\":\"capture\",\"step\":3,\"seed\":9,\"folder\":\"" +
      (folder / "").string() +
      "\"}\n"
      "{\"id\":5,\"request\":\"bye\"}\n{\"id\":6,\"request\":\"stop\"}\n");
  ASSERT_EQ(lines.size(), 4u);
  const DriverAnswer hello(lines[0]), move(lines[2]), capture(lines[3]);
  EXPECT_EQ(hello.error(), std::nullopt);
  EXPECT_EQ(hello.whole_number("width", 0, 9), 2);
  EXPECT_FALSE(hello.has("start") || hello.has("object"));
  EXPECT_EQ(hello.texts_by_key("settings").at("sensor.dropout"), "0.1");
  EXPECT_EQ(DriverAnswer(lines[1]).reaches("reach", 1)[0].cost.distance, 0.0);
  EXPECT_EQ(move.pose("pose").translation(), Vector3(0.1, 0.2, 2.0));
  EXPECT_EQ(capture.id(), 4u);
  EXPECT_EQ(capture.pose("pose").translation(), Vector3(0.1, 0.2, 2.0));
  EXPECT_THAT(read_npy(folder / capture.text("file")).values, testing::ElementsAre(9.0f, 3.0f));
}

TEST(DriverServer, SaysWhatIsWrong) {
  const auto error = [](const std::string& request) {
    const auto lines = answers("{\"id\":1," + request + "}\n");
    return lines.size() == 1 ? DriverAnswer(lines[0]).error().value_or("none") : "no answer";
  };
  EXPECT_THAT(error("\"request\":\"hello\",\"protocol\":2"), HasSubstr("version 1"));
  EXPECT_THAT(error("\"request\":\"dance\""), HasSubstr("no request 'dance'"));
  EXPECT_THAT(error("\"request\":\"move\",\"pose\":[1]"), HasSubstr("16 numbers"));
  EXPECT_THAT(error("\"request\":\"move\""), HasSubstr("pose"));
  EXPECT_THAT(error("\"request\":\"move\",\"pose\":[1,0,0,1e71,0,1,0,0,0,0,1,0,0,0,0,1]"), HasSubstr("m off"));
  EXPECT_THAT(error("\"request\":\"capture\",\"step\":7,\"folder\":\"/\""), HasSubstr("lens cap"));
  EXPECT_THAT(error("\"request\":\"capture\",\"step\":1,\"folder\":\"/no/such\""), HasSubstr("/no/such"));
  EXPECT_EQ(answers("hello\n[]\n{}\n").size(), 3u);
}

TEST(DriverServer, AStopInterruptsACapture) {
  const auto lines = answers(
      "{\"id\":1,\"request\":\"capture\",\"step\":8,\"folder\":\"/\"}\n{\"id\":2,\"request\":\"stop\"}\n"
      "{\"id\":3,\"request\":\"move\",\"pose\":" +
      pose + "}\n{\"id\":4,\"request\":\"hello\",\"protocol\":1}\n");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(DriverAnswer(lines[0]).error(), "stopped");
  EXPECT_EQ(DriverAnswer(lines[1]).error(), std::nullopt);
  EXPECT_EQ(DriverAnswer(lines[2]).error(), std::nullopt) << "and nothing after it";
}

TEST(DriverServer, TheEndOfTheInputEndsWhatIsOpen) {
  EXPECT_EQ(answers("{\"id\":1,\"request\":\"capture\",\"step\":8,\"folder\":\"/\"}\n").size(), 1u);
}

}  // namespace
}  // namespace nextview
