#include "ui/workbench/found_surface.hpp"

#include "core/progress/stopped.hpp"
#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

/// What the surface is made of, and compared with. @throws Stopped
ReconstructionInput input_of(const SurfaceQuestion& question, const std::stop_token& stop) {
  const SessionSnapshot& s = *question.session;
  ReconstructionInput input{s.grid, chosen_bricks(s, question.map)};
  if (question.map == MapChoice::gibbs && s.gibbs) input.prior = s.gibbs->config.prior;
  for (const auto& scan : s.scans) input.scans.push_back(scan.get());
  if (s.setup->truth && s.mesh) {
    input.true_mesh = s.mesh.get();
    input.samples = &s.setup->truth->samples();
    input.visible = s.setup->truth->visible(stop);
    input.on_ground = s.configuration.object.ground;
  }
  return input;
}

}  // namespace

bool SurfaceQuestion::same_as(const SurfaceQuestion& other) const {
  if (!session || !other.session) return !session && !other.session;
  const bool of_map = source == SurfaceSource::map;
  return session->session == other.session->session && session->map == other.session->map && source == other.source &&
         (!of_map || (map == other.map && session->gibbs == other.session->gibbs));
}

std::shared_ptr<const FoundSurface> find_surface(const SurfaceQuestion& question, const Progress& progress,
                                                 const std::stop_token& stop) {
  try {
    auto found = std::make_shared<FoundSurface>();
    found->of = question;
    if (!question.session->records.empty())
      found->found = scan_surface(input_of(question, stop), question.source, progress, stop);
    return found;
  } catch (const Stopped&) {
    return nullptr;
  } catch (const std::exception& error) {  // such as a lack of memory: the scan stands all the same
    auto none = std::make_shared<FoundSurface>();
    none->of = question;
    none->found.surface.why_empty = error.what();
    return none;
  }
}

}  // namespace nextview
