#pragma once
#include <random>
#include <string>
#include <vector>

#include "ui/commands/command_list.hpp"

namespace nextview {

/// Draws commands and values as their declarations have them. The same calls for the same seed.
class RandomCalls {
 public:
  /// `folder`: files are written there. `configuration`: a file that `open` may open.
  RandomCalls(std::uint64_t seed, std::filesystem::path folder, std::filesystem::path configuration)
      : random_(seed), folder_(std::move(folder)), configuration_(std::move(configuration)) {}

  /// Any command but `quit`, with values of the declared kinds; one value in `often` is none that is allowed.
  std::pair<const Command*, std::vector<std::string>> next(const SessionSnapshot& session, int often = 12);
  /// From 0 to `count` - 1.
  std::size_t below(std::size_t count) { return std::size_t(random_() % count); }

  /// A valid value; `given` are those before it.
  std::string value(const Command& command, const Argument& argument, const std::vector<std::string>& given,
                    const SessionSnapshot& session);

 private:
  std::string number(const Command& command, const Argument& argument);
  std::string file(const Command& command);
  std::string setting(const std::string& key);

  std::mt19937_64 random_;
  std::filesystem::path folder_, configuration_;
};

}  // namespace nextview
