#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/configuration.hpp"

namespace nextview {

/// What is compared with what: plans of views, or maps made of the same views.
enum class StudyPart { planning, maps };
constexpr std::string_view name(StudyPart part) { return part == StudyPart::planning ? "planning" : "maps"; }

/// A setting that a study file gives, and where.
struct GivenSetting {
  std::string key, text;
  std::string place;  ///< "study.toml:12"
};

/// What a name in a study means beyond itself: a sensor, a policy or a map, and whatever settings go with it.
struct StudyVariant {
  std::string
      configuration;  ///< file that all else overrides, or the name of one that comes with the program; or empty
  std::string kind;   ///< of a map: octomap, per-ray, …, gibbs; empty: its name
  std::vector<GivenSetting> settings;
};

/// The camera of a scan that says nothing of it: a preset would keep its lengths, whatever the object's size.
inline constexpr const char* default_sensor = "default";

/// Each object with each sensor, number of views, method, start view and seed.
struct StudyBlock {
  StudyPart part = StudyPart::planning;
  std::vector<std::string> objects, sensors;
  std::vector<int> views;
  std::vector<std::string> methods;  ///< policies, or maps
  std::vector<std::string> starts;   ///< "azimuth elevation" of the start view [deg]; of maps one, empty
  std::vector<std::uint64_t> seeds;
  std::string reference;  ///< the method that the others are compared with; empty: none
  std::string place;      ///< of it in the file

  std::size_t runs_of_a_method() const { return starts.size() * seeds.size(); }
  std::size_t size() const {
    return objects.size() * sensors.size() * views.size() * methods.size() * runs_of_a_method();
  }
};

/// One run, by the names that the study has for it.
struct StudyRun {
  std::size_t block = 0;
  StudyPart part = StudyPart::planning;
  std::string object, sensor;
  int views = 0;
  std::string method, start;
  std::uint64_t seed = 1;

  /// "bunny, paper, 12 views, random, start 30 20, seed 3"
  std::string text() const;
};

/// A study as its file has it.
struct Study {
  std::string name;
  std::filesystem::path file;
  std::string text;  ///< of the file
  std::vector<GivenSetting> settings;
  std::map<std::string, StudyVariant> sensors, policies, maps;
  std::vector<StudyBlock> blocks;

  std::size_t size() const;  ///< number of runs
  /// The runs in their fixed order, from 0: the seed changes fastest, then start view, method, views, sensor, object.
  StudyRun run(std::size_t index) const;
  const StudyVariant& variant(const StudyRun& run) const;  ///< of its method
  /// What kind of map a run of maps makes.
  std::string map_kind(const StudyRun& run) const;
};

/// Gives the blocks of a study that was read their usual references, and sees that all of it makes sense: each
/// combination of settings must be valid before the first run begins. @throws std::runtime_error "file:line: reason"
void complete(Study& study);

/// @throws std::runtime_error "file:line: reason"
Study read_study(const std::filesystem::path& file);

/// All that a run is made with.
Configuration configuration_of(const Study& study, const StudyRun& run);

/// Where the file that a study names lies: beside the study, or as it stands.
std::string beside_study(const std::filesystem::path& file, const std::string& said);

/// Part of an object's name that is written: "motor" of "/usr/share/motor.stl".
std::string object_label(const std::string& object);

}  // namespace nextview
