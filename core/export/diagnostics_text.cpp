#include "core/export/diagnostics_text.hpp"

#include <fmt/format.h>

#include "core/file/json_text.hpp"

namespace nextview {

std::string diagnostics_json(const SamplerDiagnostics& d) {
  return json_text(nlohmann::ordered_json{{"measured_rays", d.measured_rays},
                                          {"merged_rays", d.merged_rays},
                                          {"observed_voxels", d.observed_voxels},
                                          {"informed_voxels", d.informed_voxels},
                                          {"incidences", d.incidences},
                                          {"list_bytes", d.list_bytes},
                                          {"chain_bytes", d.chain_bytes},
                                          {"sweeps", d.sweeps},
                                          {"burn_in", d.burn_in},
                                          {"r_hat", d.r_hat},
                                          {"effective_samples", d.effective_samples},
                                          {"trend_z", d.trend},
                                          {"voxel_r_hat_percentile_95", d.voxel_r_hat},
                                          {"voxel_effective_samples_percentile_5", d.voxel_effective_samples},
                                          {"disagreeing_voxels", d.disagreeing_voxels},
                                          {"divergence_of_means_nats", d.divergence},
                                          {"stationary", d.stationary},
                                          {"warning", d.warning}});
}

std::string diagnostics_line(const SamplerDiagnostics& d) {
  if (!d.warning.empty()) return d.warning;
  return fmt::format("stationary after {} sweeps (R-hat {:.3f}, trend |z| {:.1f}, {} voxels differ between chains)",
                     d.sweeps, d.r_hat, d.trend, d.disagreeing_voxels);
}

}  // namespace nextview
