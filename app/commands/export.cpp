#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <sstream>

#include "app/commands/commands.hpp"
#include "app/commands/opened_session.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "core/export/frame_folder.hpp"
#include "core/export/single_export.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/saved_session.hpp"
#include "ui/charts/chart_page.hpp"
#include "ui/charts/scan_curves.hpp"
#include "ui/figures/scene_figure.hpp"
#include "ui/figures/session_figure.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string session, what, file, size, of, look_from, layers;
  std::optional<int> step;
  int frames = 36;
  bool unseen = false, transparent = false;

  ExportKind kind() const { return export_entry(what).kind; }
  fs::path path() const { return file; }
};

/// An option that means nothing to what is exported would be passed over in silence.
void require_meaning(const ExportArguments& a) {
  const ExportKind kind = a.kind();
  const bool is_scene = kind == ExportKind::picture || kind == ExportKind::turntable;
  const bool is_drawn = is_scene || (kind == ExportKind::curves && a.path().extension() != ".csv");
  const auto require = [&](bool given, bool meant, const char* option, const char* of_what) {
    if (given && !meant) throw std::invalid_argument(fmt::format("{}: is an option of {} only", option, of_what));
  };
  require(!a.of.empty(), kind == ExportKind::surface, "--of", "surface");
  require(a.unseen, kind == ExportKind::surface && a.of != "cloud", "--unseen", "surface --of map");
  require(!a.size.empty(), is_drawn, "--size", "picture, turntable and drawn curves");
  require(a.transparent, is_drawn, "--transparent", "picture, turntable and drawn curves");
  require(!a.look_from.empty(), is_scene, "--look-from", "picture and turntable");
  require(!a.layers.empty(), is_scene, "--layers", "picture and turntable");
}

PictureSize size_of(const ExportArguments& a, const PictureSize& usual) {
  return a.size.empty() ? usual : picture_size(a.size, "--size");
}

ViewDirection direction_of(const ExportArguments& a) {
  ViewDirection direction;
  if (a.look_from.empty()) return direction;
  char comma = 0, more = 0;
  std::istringstream text(a.look_from);
  if (!(text >> direction.azimuth >> comma >> direction.elevation) || comma != ',' || text >> more ||
      !(std::abs(direction.azimuth) <= 360.0) || !(std::abs(direction.elevation) <= 90.0))
    throw std::invalid_argument(fmt::format(
        "--look-from: takes AZIMUTH,ELEVATION in degrees, the second from -90 to 90, not '{}'", a.look_from));
  return direction;
}

SceneLayers layers_of(const ExportArguments& a) {
  if (a.layers.empty()) return {};
  SceneLayers layers{false, false, false, false, false, false};
  const std::vector<std::pair<std::string, bool*>> known = {{"object", &layers.object}, {"cloud", &layers.cloud},
                                                            {"map", &layers.map},       {"views", &layers.views},
                                                            {"rays", &layers.rays},     {"region", &layers.region}};
  std::istringstream list(a.layers);
  for (std::string name; std::getline(list, name, ',');) {
    const auto found = std::ranges::find(known, name, &std::pair<std::string, bool*>::first);
    if (found == known.end())
      throw std::invalid_argument(
          fmt::format("--layers: takes some of object,cloud,map,views,rays,region, not '{}'", name));
    *found->second = true;
  }
  return layers;
}

SurfaceExport surface_of(const ExportArguments& a) {
  if (!a.of.empty() && a.of != "map" && a.of != "cloud")
    throw std::invalid_argument(fmt::format("--of: takes map or cloud, not '{}'", a.of));
  return {a.of == "cloud" ? SurfaceSource::cloud : SurfaceSource::map, a.unseen};
}

/// The settings as a picture carries them: as config.toml beside it would.
std::string configuration_text(const Session& session, const fs::path& file) {
  return to_toml(session.configuration(), file.has_parent_path() ? file.parent_path() : ".");
}

void draw_curves(const Session& session, const ExportArguments& a) {
  const std::vector<ChartContent> charts = session_charts(session);
  const PictureSize size = size_of(a, page_size(charts.size()));
  if (a.path().extension() == ".svg") return write_file(a.path(), charts_svg(charts, size, a.transparent));
  OffscreenTarget target(smallest_picture, smallest_picture);
  write_png(draw_charts(target, charts, size, a.transparent), a.path(), configuration_text(session, a.path()));
}

/// Returns what was written.
std::string draw_scene(const Session& session, const ExportArguments& a, const ProgressLine& progress,
                       const std::stop_token& stop) {
  OffscreenTarget target(smallest_picture, smallest_picture);
  SceneFigure figure(target, session, layers_of(a), size_of(a, {}));
  const std::string configuration = configuration_text(session, a.path());
  if (a.kind() == ExportKind::picture) {
    write_png(figure.draw(direction_of(a), a.transparent), a.path(), configuration);
    return a.file;
  }
  make_frame_folder(a.path());
  for (int k = 0; k < a.frames; ++k) {
    progress(double(k) / a.frames, fmt::format("drawing frame {} of {}", k + 1, a.frames));
    throw_if_stopped(stop);
    write_png(figure.draw_turned(direction_of(a), k, a.frames, a.transparent), a.path() / frame_name(k + 1),
              configuration);
  }
  progress.clear();
  return fmt::format("{}: {} to {}", a.file, frame_name(1), frame_name(a.frames));
}

/// What can be told before the session is opened, which takes a while.
void check(const ExportArguments& a) {
  require_meaning(a);
  surface_of(a), layers_of(a), direction_of(a), size_of(a, {});
  require_exportable(a.kind(), a.path(), read_session(a.session).configuration, a.session);
  if (a.kind() != ExportKind::turntable) AtomicFile can_be_written(a.path());
}

int run(const ExportArguments& a) {
  check(a);
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const auto session = opened_session(a.session, a.step, progress, stop.token());
  if (session->records().empty())
    throw std::invalid_argument(a.session + ": has no view yet, so there is nothing to export");
  std::vector<std::string> written;
  if (a.kind() == ExportKind::picture || a.kind() == ExportKind::turntable) {
    written = {draw_scene(*session, a, progress, stop.token())};
  } else if (a.kind() == ExportKind::curves && a.path().extension() != ".csv") {
    draw_curves(*session, a);
    written = {a.file};
  } else {
    for (const fs::path& file :
         export_file(*session, a.kind(), a.path(), surface_of(a), nullptr, progress, stop.token()))
      written.push_back(file.string());
    progress.clear();
  }
  for (const std::string& file : written) fmt::print("{}\n", printable(file));
  return 0;
}

/// "cloud (.ply or .pcd), …"
std::string kinds_text() {
  std::string text;
  for (const ExportEntry& entry : export_entries())
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", entry.name,
                        entry.endings.empty() ? "a folder" : entry.endings_text());
  return text;
}

}  // namespace

void add_export_command(CLI::App& program) {
  auto a = std::make_shared<ExportArguments>();
  CLI::App* app = program.add_subcommand("export", "Write one thing of a session: cloud, map, surface, views, …");
  app->add_option("SESSION", a->session, "folder of a session, as `scan --out` leaves it")
      ->transform(kept_session())
      ->required();
  app->add_option("WHAT", a->what, kinds_text())->required();
  app->add_option("FILE", a->file, "where to; its ending says the format, and a file of this name is replaced")
      ->required();
  app->add_option("--step", a->step, "as it was after so many views; else as it stands")->check(within(1, 1000000));
  app->add_option("--of", a->of, "the surface of the map, or that of the cloud (default map)")->type_name("map|cloud");
  app->add_flag("--unseen", a->unseen,
                "also what closes the map's surface where no view has looked, into NAME_unseen beside NAME");
  app->add_option("--size", a->size,
                  fmt::format("of a picture in pixels, each side from {} to {} (default 1280x800)", smallest_picture,
                              largest_picture))
      ->type_name("WxH");
  app->add_flag("--transparent", a->transparent, "without a background");
  app->add_option("--look-from", a->look_from, "where the scene is looked at from [deg] (default -50,24)")
      ->type_name("AZIMUTH,ELEVATION");
  app->add_option("--layers", a->layers, "some of object,cloud,map,views,rays,region (default: all)")
      ->type_name("LIST");
  app->add_option("--frames", a->frames, "of a turntable")->check(within(2, 3600))->capture_default_str();
  app->footer(
      "Examples:\n  nextview export out cloud cloud.pcd\n  nextview export out surface part.stl --unseen\n"
      "  nextview export out views poses.txt --step 8\n  nextview export out curves curves.svg\n"
      "  nextview export out picture scene.png --size 3840x2400 --transparent --layers object,views\n"
      "  nextview export out turntable frames --frames 72");
  app->callback([a] { throw CLI::RuntimeError(run(*a)); });
}

}  // namespace nextview
