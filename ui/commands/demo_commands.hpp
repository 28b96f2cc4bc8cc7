#pragma once
#include "ui/commands/command.hpp"

namespace nextview {

enum class Quantity { views, coverage, surface_left, entropy, gibbs_views };
enum class Relation { equal, less, at_most, more, at_least };

namespace command {

// What demos have besides the window's own commands (presentation.hpp).
extern const CommandOf<std::string, std::optional<double>> caption;             ///< text, seconds
extern const CommandOf<std::string, double, std::optional<std::string>> title;  ///< text, seconds, subtitle
extern const CommandOf<std::string, double> highlight;                          ///< panel, seconds
extern const CommandOf<double, double, std::optional<double>> orbit;  ///< azimuth [deg], seconds, elevation [deg]
/// azimuth, elevation [deg], seconds, zoom, and what it looks at in the end [m, world]
extern const CommandOf<double, double, double, std::optional<double>, std::optional<double>, std::optional<double>,
                       std::optional<double>>
    fly_to;
extern const CommandOf<std::string> split;           ///< a branch
extern const CommandOf<std::optional<double>> wait;  ///< seconds; none: until all is done
extern const CommandOf<Quantity, Relation, double> assert_that;

}  // namespace command
}  // namespace nextview
