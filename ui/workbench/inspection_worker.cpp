#include "ui/workbench/inspection_worker.hpp"

#include "core/progress/seconds_left.hpp"

namespace nextview {

InspectionWorker::InspectionWorker(std::function<void()> on_news)
    : inspections_(
          [this](const Question& question, const std::stop_token&) {
            return std::make_shared<const Inspection>(inspector_.inspect(question.session, question.selection));
          },
          on_news),
      surfaces_(
          [this, on_news](const SurfaceQuestion& question, const std::stop_token& stop) {
            const auto progress = [&](double fraction, std::string_view) {
              surface_fraction_ = fraction;
              if (on_news) on_news();
            };
            return find_surface(question, progress, stop);
          },
          on_news) {}

void InspectionWorker::ask_surface(const SurfaceQuestion& question) {
  surface_fraction_ = 0.0;
  surface_asked_ = std::chrono::steady_clock::now();
  surfaces_.ask(question);
}

std::optional<SurfaceJob> InspectionWorker::surface_progress() const {
  if (!surfaces_.busy()) return std::nullopt;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - surface_asked_;
  return SurfaceJob{surface_fraction_, seconds_left(surface_fraction_, elapsed.count())};
}

}  // namespace nextview
