#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/study/study.hpp"

namespace nextview {
namespace {

constexpr std::size_t most_runs = 100'000'000;

/// What stands twice, for people; empty if nothing does.
template <class Value>
std::string twice(std::vector<Value> values) {
  std::ranges::sort(values);
  const auto found = std::ranges::adjacent_find(values);
  return found == values.end() ? "" : fmt::format("{}", *found);
}

void complete_block(StudyBlock& block) {
  const char* methods = block.part == StudyPart::planning ? "policies" : "maps";
  const auto require = [&](bool good, const std::string& what) {
    if (!good) throw std::runtime_error(block.place + ": " + what);
  };
  const auto has = [&](const std::string& method) {
    return std::ranges::find(block.methods, method) != block.methods.end();
  };
  require(!block.objects.empty(), "a block needs 'objects'");
  std::vector<std::string> labels;
  for (const std::string& object : block.objects) labels.push_back(object_label(object));
  const std::string label = twice(labels);
  require(label.empty(),
          fmt::format("two objects are called '{}': what is told of them by name would be one's", label));
  const auto once = [&](const auto& values, const char* key) {
    const std::string value = twice(values);
    require(value.empty(), fmt::format("'{}' stands twice in '{}': it would count twice", value, key));
  };
  once(block.methods, methods);
  once(block.sensors, "sensors"), once(block.views, "views");
  once(block.starts, "starts"), once(block.seeds, "seeds");
  require(!block.methods.empty(), fmt::format("a block needs '{}'", methods));
  require(block.reference.empty() || has(block.reference),
          fmt::format("the reference, '{}', is none of the block's {}", block.reference, methods));
  const char* usual = block.part == StudyPart::planning ? "random" : "octomap";
  if (block.reference.empty() && has(usual)) block.reference = usual;
}

/// Of the runs from `first` on.
void check_settings(const Study& study, const StudyBlock& block, std::size_t first) {
  const std::size_t of_an_object = block.size() / block.objects.size();
  for (std::size_t i = 0; i < of_an_object; i += block.seeds.size()) {  // a seed is always valid
    try {
      configuration_of(study, study.run(first + i)).validate();
    } catch (const std::invalid_argument& error) {
      const std::string reason = error.what();
      const bool has_place = reason.starts_with(study.file.string() + ":");
      throw std::runtime_error(has_place ? reason : fmt::format("{}: {}", block.place, reason));
    }
  }
}

}  // namespace

void complete(Study& study) {
  const std::string file = study.file.string();
  if (study.blocks.empty())
    throw std::runtime_error(fmt::format("{}: compares nothing: there is no [[planning]] and no [[maps]]", file));
  std::size_t first = 0;
  for (StudyBlock& block : study.blocks) complete_block(block);
  if (study.size() > most_runs)
    throw std::runtime_error(fmt::format("{}: {} runs; at most {} are allowed", file, study.size(), most_runs));
  for (const StudyBlock& block : study.blocks) {
    check_settings(study, block, first);
    first += block.size();
  }
}

}  // namespace nextview
