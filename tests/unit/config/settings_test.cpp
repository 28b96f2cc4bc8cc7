#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/config/configuration.hpp"
#include "core/planner/gain_policies.hpp"
#include "core/setting/quantity.hpp"

namespace nextview {
namespace {

Setting find(Configuration& configuration, const std::string& key) {
  for (Setting& s : settings(configuration))
    if (s.key == key) return s;
  throw std::logic_error("no setting " + key);
}

/// Another value than the one it has, as text.
std::string another(const Setting& setting) {
  struct Another {
    std::string operator()(const bool* v) const { return *v ? "false" : "true"; }
    std::string operator()(const int* v) const { return std::to_string(*v + 1); }
    std::string operator()(const std::uint64_t* v) const { return std::to_string(*v + 1); }
    std::string operator()(const double* v) const { return std::to_string(*v / 2 + 0.17); }
    std::string operator()(const std::string*) const { return "another text"; }
    std::string operator()(const Setting::Choice& c) const { return c.names[(c.get() + 1) % c.names.size()]; }
  };
  return std::visit(Another{}, setting.value);
}

TEST(Settings, KeysAreUniqueAndExplained) {
  Configuration configuration;
  std::set<std::string> keys;
  for (const Setting& s : settings(configuration)) {
    EXPECT_TRUE(keys.insert(s.key).second) << s.key;
    EXPECT_FALSE(s.help.empty()) << s.key;
    EXPECT_EQ(s.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_."), std::string::npos) << s.key;
  }
  EXPECT_GT(keys.size(), 40u);
}

// Each one reaches the configuration, and no other setting with it.
TEST(Settings, EachIsSetFromText) {
  Configuration untouched;
  const auto before = settings(untouched);
  for (std::size_t i = 0; i < before.size(); ++i) {
    Configuration configuration;
    auto all = settings(configuration);
    const std::string text = another(all[i]);
    all[i].set(text);
    const auto after = settings(configuration);
    for (std::size_t k = 0; k < after.size(); ++k) {
      if (k != i)
        EXPECT_EQ(after[k].text(), before[k].text()) << before[i].key << " changes " << before[k].key;
      else
        EXPECT_NE(after[k].text(), before[k].text()) << before[i].key << " = " << text;
    }
  }
}

TEST(Settings, TextIsReadBackExactly) {
  Configuration a, b;
  for (const double value : {0.1, 1.0 / 3.0, 1e-9, 12345.678901234567, 5e-324, 1.7976931348623157e308, -0.0}) {
    a.map.resolution = value;
    find(b, "map.resolution").set(find(a, "map.resolution").text());
    EXPECT_EQ(a.map.resolution, b.map.resolution);
  }
  Configuration c;
  find(c, "seed").set("9223372036854775807");
  EXPECT_NO_THROW(c.validate());
  find(c, "seed").set("18446744073709551615");  // TOML could not hold it
  EXPECT_THROW(c.validate(), std::invalid_argument);
}

TEST(Settings, WrongTextsNameTheKeyAndChangeNothing) {
  Configuration configuration;
  const auto rejects = [&](const std::string& key, const std::string& text) {
    Setting setting = find(configuration, key);
    const std::string before = setting.text();
    try {
      setting.set(text);
      ADD_FAILURE() << key << " = '" << text << "' was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
    EXPECT_EQ(setting.text(), before);
  };
  for (const char* bad : {"", " ", "x", "12x", "1.5", "1e3", "0x10", "99999999999999999999", "true", "--3"})
    rejects("sensor.width", bad);
  for (const char* bad : {"", "x", "1.5x", "1,5", "true", "1e999"}) rejects("map.resolution", bad);
  for (const char* bad : {"", "1", "yes", "True", "truefalse"}) rejects("evaluation.enabled", bad);
  for (const char* bad : {"", "-1", "1.0", "18446744073709551616"}) rejects("seed", bad);
  for (const char* bad : {"", "spher", "SPHERE", "0"}) rejects("views.layout", bad);
  rejects("planner.gain", "occlusion");
}

TEST(Settings, AChoiceSuggestsTheNearest) {
  Configuration configuration;
  try {
    find(configuration, "planner.gain").set("oclusion-awar");
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("occlusion-aware"), std::string::npos) << error.what();
  }
}

TEST(Validate, TheDefaultsAreGood) { EXPECT_NO_THROW(Configuration().validate()); }

// What is just within the bounds is taken, what is just outside is not, and the message is all of it.
TEST(Validate, EachNumberHasItsBoundsAndTheMessageNamesThem) {
  Configuration names;
  for (const Setting& s : settings(names)) {
    const bool is_int = std::holds_alternative<int*>(s.value);
    ASSERT_EQ(s.bounds.has_value(), is_int || std::holds_alternative<double*>(s.value)) << s.key;
    if (!s.bounds) continue;
    const auto below = [&](double v) { return is_int ? v - 1 : std::nextafter(v, -1e300); };
    const auto above = [&](double v) { return is_int ? v + 1 : std::nextafter(v, 1e300); };
    const auto refusal = [&](double value) -> std::string {
      Configuration configuration;
      try {
        const Setting setting = find(configuration, s.key);
        Setting(setting).set(is_int ? std::to_string(int(value)) : fmt::format("{}", value));
        setting.require_in_bounds();
        return "";
      } catch (const std::invalid_argument& error) {
        return error.what();
      }
    };
    const auto refused = [&](double value) {
      const std::string text = find(names, s.key).bounds->text(s.unit);
      const std::string is = s.unit == "m" ? quantity_text(value) : fmt::format("{}", is_int ? int(value) : value);
      return fmt::format("{} must be {}, not {}", s.key, text, is);
    };
    const auto [low, high] = std::pair{s.bounds->low, s.bounds->high};
    EXPECT_EQ(refusal(s.bounds->low_included ? low : above(low)), "");
    EXPECT_EQ(refusal(s.bounds->high_included ? high : below(high)), "");
    EXPECT_EQ(refusal(s.bounds->low_included ? below(low) : low),
              s.bounds->or_zero && low == 0 ? "" : refused(s.bounds->low_included ? below(low) : low));
    EXPECT_EQ(refusal(s.bounds->high_included ? above(high) : high),
              refused(s.bounds->high_included ? above(high) : high));
    if (s.bounds->or_zero) {
      EXPECT_EQ(refusal(0.0), "");
    }
  }
}

// No number takes NaN, infinity or something far below 0, whichever setting it is.
TEST(Validate, RejectsWhatIsNoUsableNumber) {
  Configuration names;
  for (const Setting& s : settings(names)) {
    const bool is_double = std::holds_alternative<double*>(s.value), is_int = std::holds_alternative<int*>(s.value);
    std::vector<std::string> bad;
    if (is_double) bad = {"nan", "inf", "-inf", "-1e6", "1e300"};
    if (is_int) bad = {"-2", "-2147483648"};
    for (const std::string& text : bad) {
      Configuration configuration;
      configuration.views.layout = ViewLayout::rings;
      configuration.cloud.down_sampling = true;
      try {
        find(configuration, s.key).set(text);
        configuration.validate();
        ADD_FAILURE() << s.key << " = " << text << " was accepted";
      } catch (const std::invalid_argument& error) {
        const std::string what = error.what(), field = s.key.substr(s.key.find('.') + 1);
        EXPECT_NE(what.find(field), std::string::npos) << s.key << " = " << text << ": " << what;
        EXPECT_EQ(what.find('\n'), std::string::npos);
      }
    }
  }
}

// With views from a file the radius is that of the start view alone.
TEST(Validate, TheStartViewNeedsARadiusWhateverTheLayout) {
  Configuration configuration;
  configuration.views.layout = ViewLayout::file;
  configuration.views.file = "views.txt";
  EXPECT_NO_THROW(configuration.validate());
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    configuration.views.radius = bad;
    EXPECT_THROW(configuration.validate(), std::invalid_argument) << bad;
  }
}

TEST(Validate, BaselinesThatKnowTheObjectNeedTheEvaluation) {
  for (const std::string& gain : policy_names()) {
    Configuration configuration;
    configuration.planner.gain = gain;
    EXPECT_NO_THROW(configuration.validate()) << gain;
    configuration.evaluation.enabled = false;
    if (gain == "oracle" || gain == "covering-order" || gain == "set-cover")
      EXPECT_THROW(configuration.validate(), std::invalid_argument) << gain;
    else
      EXPECT_NO_THROW(configuration.validate()) << gain;
  }
}

TEST(Validate, TheReferenceCodeKnowsNoDecayOfTerms) {
  for (const char* key : {"map.hit_decay", "map.miss_decay"}) {
    Configuration configuration;
    find(configuration, key).set("0.5");
    EXPECT_NO_THROW(configuration.validate()) << key;
    configuration.planner.semantics = Semantics::reference;
    EXPECT_THROW(configuration.validate(), std::invalid_argument) << key;
    find(configuration, key).set("0");
    EXPECT_NO_THROW(configuration.validate()) << key;
  }
}

TEST(CombinedWeights, AreReadOrRefused) {
  for (const char* good : {"", "average-entropy=2.5,rear-side-voxel=1", "gibbs=1e-3"})
    EXPECT_NO_THROW(CombinedPolicy policy(good)) << good;
  for (const char* bad : {"average-entropy", "average-entropy=", "average-entropy=x", "average-entropy=1x", "=1", ",",
                          "average-entropy=nan", "average-entropy=inf", "unknown=1", "combined=1", "random=1",
                          "average-entropy=1,,rear-side-voxel=1", "average-entropy=1;rear-side-voxel=1"}) {
    EXPECT_THROW(CombinedPolicy policy(bad), std::invalid_argument) << bad;
    Configuration configuration;
    configuration.planner.combined_weights = bad;
    EXPECT_THROW(configuration.validate(), std::invalid_argument) << bad;
  }
}

TEST(Policies, AreTheGainsTheCombinationAndTheBaselines) {
  const auto names = policy_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_GE(names.size(), 13u);
  EXPECT_EQ(std::ranges::count_if(policies(), &PolicyEntry::baseline), 7);
  for (const PolicyEntry& policy : policies())
    if (policy.name == "combined" || policy.name == "occlusion-aware") {
      EXPECT_FALSE(policy.baseline) << policy.name;
    }
}

TEST(Configurations, ThoseThatComeWithTheProgramAreGoodAndChangeSomething) {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(assets_folder() / "configurations")) {
    Configuration other;
    other.planner.new_surface = {};  // new_surface.toml has the default
    const Configuration configuration = read_configuration(file, other);
    EXPECT_NO_THROW(configuration.validate()) << file;
    EXPECT_NE(to_toml(configuration), to_toml(other)) << file;
    names.insert(file.path().stem().string());
  }
  EXPECT_EQ(names, (std::set<std::string>{"calibrated", "new_surface", "paper", "published_bunny"}))
      << "--help names these";
}

}  // namespace
}  // namespace nextview
