// `--config new_surface` is what the program expects by default, and sets nothing else.
// NEXTVIEW_UPDATE_NEW_SURFACE=1 in the environment writes the file anew, after another fit.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/config/configuration.hpp"
#include "core/config/settings_file.hpp"
#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

constexpr const char* remark =
    "Where rays meet new surface, as the gain new-surface expects it by default: learned from parts that `nextview\n"
    "calibrate --fit new-surface` makes up. To start from, or to go back to from another file's.\n"
    "`nextview scan --config new_surface`.";

TEST(NewSurfaceConfiguration, IsWhatTheProgramExpectsByDefaultAndSetsNothingElse) {
  const auto file = std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets/configurations/new_surface.toml";
  NewSurfaceModel fitted = NewSurfaceModel::fitted();
  if (std::getenv("NEXTVIEW_UPDATE_NEW_SURFACE")) write_file(file, settings_file(settings(fitted), remark));
  Configuration base;
  base.planner.new_surface = {}, base.planner.gain = "random", base.seed = 77;
  Configuration expected = base;
  expected.planner.new_surface = fitted;
  EXPECT_EQ(read_configuration(file, base).planner.new_surface, fitted)
      << "NEXTVIEW_UPDATE_NEW_SURFACE=1 renews " << file;
  EXPECT_EQ(to_toml(read_configuration(file, base)), to_toml(expected));
}

}  // namespace
}  // namespace nextview
