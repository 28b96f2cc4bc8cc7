#include "core/driver/driver_protocol.hpp"

#include <gmock/gmock.h>

#include "core/driver/driver_answer.hpp"
#include "core/file/read_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string needed =
    R"("protocol":1,"name":"arm","intrinsics":[4,5,1.5,1],"width":4,"height":3,"max_range":2,"range_noise":0.001)";

DriverAnswer answer_with(const std::string& more) { return DriverAnswer("{\"id\":1,\"ok\":true," + more + "}"); }

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "it is taken";
}

/// A driver written down line by line: it answers hello, then the second request with `answer`, and keeps what it was
/// told.
class ToldDriver {
 public:
  std::vector<std::string> words(const std::string& abilities, const std::string& answer) const {
    const std::string hello = "{\"id\":1,\"ok\":true," + needed + ",\"abilities\":[" + abilities + "]}";
    return {"sh", "-c",
            "while read -r line; do echo \"$line\" >>\"$0\"; case \"$line\" in *hello*) echo '" + hello +
                "';; *move*) " + answer + ";; *bye*) exit;; esac; done",
            (folder_ / "told").string()};
  }
  /// The requests that it was sent, in order.
  std::vector<std::string> told() const {
    std::vector<std::string> requests;
    std::istringstream lines(read_file(folder_ / "told"));
    const std::string key = "\"request\":\"";
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begin = line.find(key) + key.size();
      requests.push_back(line.substr(begin, line.find('"', begin) - begin));
    }
    return requests;
  }

 private:
  TemporaryFolder folder_;
};

/// What a driver is told around a move that it answers like this.
std::vector<std::string> told_around_move(const std::string& abilities, const std::string& answer, double seconds,
                                          const std::string& reason) {
  const ToldDriver driver;
  {
    DriverProtocol protocol(driver.words(abilities, answer), {}, 5.0, 0.2);
    const auto greeting = protocol.hello({});
    EXPECT_TRUE(std::holds_alternative<DriverGreeting>(greeting));
    const auto moved = protocol.move(Pose::Identity(), {.seconds = seconds});
    const auto* failure = std::get_if<Failure>(&moved);
    EXPECT_NE(failure, nullptr);
    if (failure) {
      EXPECT_EQ(failure->kind, Failure::disconnected);
      EXPECT_THAT(failure->reason, AllOf(HasSubstr("driver arm: move: "), HasSubstr(reason)));
    }
    EXPECT_FALSE(protocol.has_ended());
  }
  return driver.told();
}

// It may be moving: whoever can stop is told to, also where what it said makes no sense.
TEST(DriverProtocol, WhoIsNotUnderstoodIsToldToStop) {
  for (const auto& [answer, reason] : std::vector<std::pair<std::string, std::string>>{
           {"echo nonsense", "no JSON"}, {"echo '{\"ok\":true}'", "no 'id'"}, {"echo '{\"id\":77}'", "the id 77"}}) {
    EXPECT_THAT(told_around_move("\"stop\"", answer, 5.0, reason), ElementsAre("hello", "move", "stop", "bye"));
    EXPECT_THAT(told_around_move("", answer, 5.0, reason), ElementsAre("hello", "move", "bye")) << "it cannot";
  }
}

TEST(DriverProtocol, WhoDoesNotAnswerIsToldToStop) {
  EXPECT_THAT(told_around_move("\"stop\"", ":", 0.05, "no answer within 0.05 s"),
              ElementsAre("hello", "move", "stop", "bye"));
  EXPECT_THAT(told_around_move("", ":", 0.05, "no answer within 0.05 s"), ElementsAre("hello", "move", "bye"));
}

TEST(DriverProtocol, AGreetingHoldsWhatWasSaid) {
  const DriverGreeting least = greeting_of(answer_with(needed + ",\"abilities\":[\"stop\"]"));
  EXPECT_EQ(least.name, "arm");
  EXPECT_TRUE(least.can("stop"));
  EXPECT_FALSE(least.can("sto"));
  EXPECT_EQ(least.camera.fx, 4.0);
  EXPECT_EQ(least.camera.fy, 5.0);
  EXPECT_EQ(least.camera.cx, 1.5);
  EXPECT_EQ(least.camera.cy, 1.0);
  EXPECT_EQ(least.camera.width, 4);
  EXPECT_EQ(least.camera.height, 3);
  EXPECT_EQ(least.max_range, 2.0);
  EXPECT_EQ(least.range_noise, 0.001);
  EXPECT_FALSE(least.start || least.region);
  const DriverGreeting all = greeting_of(
      answer_with(needed + R"(,"abilities":[],"region":[-1,-2,-3,4,5,6],"start":[1,0,0,7,0,1,0,8,0,0,1,9,0,0,0,1])"));
  ASSERT_TRUE(all.region && all.start);
  EXPECT_EQ(all.region->min(), Vector3(-1, -2, -3));
  EXPECT_EQ(all.region->max(), Vector3(4, 5, 6));
  EXPECT_EQ(all.start->translation(), Vector3(7, 8, 9));
}

TEST(DriverProtocol, AGreetingWithoutSenseSaysWhatIsWrong) {
  const auto greet = [](const std::string& key, const std::string& value) {
    std::string text = needed + ",\"abilities\":[],\"region\":[0,0,0,1,1,1],\"timeout\":3";
    const std::size_t begin = text.find("\"" + key + "\":") + key.size() + 3;
    const std::size_t end = text[begin] == '[' ? text.find(']', begin) + 1 : text.find(',', begin);
    text.replace(begin, std::min(end, text.size()) - begin, value);
    return refusal([&] { greeting_of(answer_with(text)); });
  };
  EXPECT_EQ(greet("timeout", "3"), "it is taken");
  EXPECT_THAT(greet("protocol", "0"), HasSubstr("speaks version 0 of the protocol, and this program version 1"));
  for (const char* focal : {"[0,5,1.5,1]", "[4,0,1.5,1]", "[-4,5,1.5,1]"})
    EXPECT_THAT(greet("intrinsics", focal), HasSubstr("need focal lengths over 0")) << focal;
  for (const char* size : {"1", "16384"}) EXPECT_EQ(greet("width", size), "it is taken") << size;
  for (const char* size : {"0", "16385"}) EXPECT_THAT(greet("width", size), HasSubstr("'width'")) << size;
  for (const char* size : {"0", "16385"}) EXPECT_THAT(greet("height", size), HasSubstr("'height'")) << size;
  EXPECT_THAT(greet("max_range", "0"), HasSubstr("'max_range'"));
  EXPECT_THAT(greet("range_noise", "-0.1"), HasSubstr("'range_noise'"));
  EXPECT_EQ(greet("range_noise", "0"), "it is taken");
  for (const char* box : {"[0,0,0,0,1,1]", "[0,0,0,1,0,1]", "[0,0,0,1,1,-1]"})
    EXPECT_THAT(greet("region", box), HasSubstr("'region' is no box")) << box;
  EXPECT_THAT(greet("timeout", "-1"), HasSubstr("'timeout'"));
  EXPECT_THAT(greet("timeout", "1000001"), HasSubstr("'timeout'"));
}

TEST(DriverProtocol, ACaptureNamesItsFileAndWhatItsNumbersAre) {
  const std::string pose = R"("pose":[1,0,0,7,0,1,0,8,0,0,1,9,0,0,0,1],"file":"a.png")";
  const CapturedFile least = captured_file_of(answer_with(pose));
  EXPECT_EQ(least.file, "a.png");
  EXPECT_EQ(least.T_world_camera.translation(), Vector3(7, 8, 9));
  EXPECT_EQ(least.scale, 0.0) << "as its kind of file has it";
  EXPECT_EQ(least.measures, "");
  const CapturedFile all = captured_file_of(answer_with(pose + R"(,"scale":0.001,"measures":"range")"));
  EXPECT_EQ(all.scale, 0.001);
  EXPECT_EQ(all.measures, "range");
  EXPECT_THAT(refusal([&] { captured_file_of(answer_with(pose + ",\"scale\":0")); }), HasSubstr("'scale'"));
  EXPECT_EQ(refusal([&] { captured_file_of(answer_with(pose + ",\"scale\":-1.0")); }),
            "'scale' must be over 0, not -1");
}

}  // namespace
}  // namespace nextview
