#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "core/planner/policy.hpp"
#include "core/session/configuration.hpp"

namespace nextview {
namespace {

template <class Enum>
Setting::Choice choice(Enum& value, std::vector<std::string> names) {
  return {std::move(names), [&value] { return static_cast<std::size_t>(value); },
          [&value](std::size_t i) { value = static_cast<Enum>(i); }};
}

Setting::Choice gain_choice(std::string& gain) {
  return {policy_names(),
          [&gain] {
            const auto names = policy_names();
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), gain) - names.begin());
          },
          [&gain](std::size_t i) { gain = policy_names()[i]; }};
}

template <class Number>
bool parse_number(const std::string& text, Number& value) {
  Number parsed{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  value = parsed;
  return true;
}

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// What a setting takes, for messages.
struct Expected {
  std::string operator()(bool*) const { return "true or false"; }
  std::string operator()(int*) const { return "a whole number"; }
  std::string operator()(std::uint64_t*) const { return "a whole number, 0 or more"; }
  std::string operator()(double*) const { return "a number"; }
  std::string operator()(std::string*) const { return "a text"; }
  std::string operator()(const Setting::Choice& c) const { return "one of " + join(c.names); }
};

struct Assign {
  const std::string& text;
  bool operator()(bool* v) const {
    if (text != "true" && text != "false") return false;
    *v = text == "true";
    return true;
  }
  bool operator()(std::string* v) const {
    *v = text;
    return true;
  }
  bool operator()(Setting::Choice& c) const {
    const auto found = std::find(c.names.begin(), c.names.end(), text);
    if (found == c.names.end()) return false;
    c.set(static_cast<std::size_t>(found - c.names.begin()));
    return true;
  }
  template <class Number>
  bool operator()(Number* v) const {
    return parse_number(text, *v);
  }
};

struct Text {
  std::string operator()(const bool* v) const { return *v ? "true" : "false"; }
  std::string operator()(const std::string* v) const { return *v; }
  std::string operator()(const double* v) const {
    const std::string text = fmt::format("{}", *v);
    return text;
  }
  std::string operator()(const Setting::Choice& c) const {
    const std::size_t i = c.get();
    return i < c.names.size() ? c.names[i] : "";
  }
  template <class Number>
  std::string operator()(const Number* v) const {
    return fmt::format("{}", *v);
  }
};

}  // namespace

std::string Setting::text() const { return std::visit(Text{}, value); }

void Setting::set(const std::string& new_text) {
  if (std::visit(Assign{new_text}, value)) return;
  std::string hint;
  if (const auto* c = std::get_if<Choice>(&value))
    hint = fmt::format("; did you mean '{}'?", nearest(new_text, c->names));
  throw std::invalid_argument(
      fmt::format("{} takes {}, not '{}'{}", key, std::visit(Expected{}, value), new_text, hint));
}

std::vector<Setting> settings(Configuration& c) {
  auto& s = c.sensor;
  auto& m = c.map.model;
  auto& g = c.gibbs.sampler;
  return {
      {"seed", "", "seed of everything random", &c.seed},
      {"object.file", "", "mesh file, or the name of an object that comes with the program", &c.object.file},
      {"object.longest_side", "m", "scale the object to this; 0 keeps its size", &c.object.longest_side},
      {"sensor.preset", "", "paper, narrow, wide, or a file; the other sensor settings override it", &c.sensor_preset},
      {"sensor.width", "px", "image width", &s.width},
      {"sensor.height", "px", "image height", &s.height},
      {"sensor.field_of_view", "deg", "horizontal field of view", &s.field_of_view},
      {"sensor.min_range", "m", "nearer surfaces give invalid pixels", &s.min_range},
      {"sensor.max_range", "m", "farther surfaces are beyond range", &s.max_range},
      {"sensor.range_noise", "m", "standard deviation along the ray", &s.range_noise},
      {"sensor.dropout", "", "share of pixels that return nothing", &s.dropout},
      {"sensor.outliers", "", "share of the other pixels whose range is any within the limits", &s.outliers},
      {"sensor.grazing_limit", "deg", "surfaces met at more than this from their normal give invalid pixels",
       &s.grazing_limit},
      {"cloud.outlier_removal", "", "statistical outlier removal", &c.cloud.outlier_removal},
      {"cloud.outlier_neighbours", "", "neighbours whose mean distance is looked at", &c.cloud.outlier_neighbours},
      {"cloud.outlier_deviations", "", "standard deviations beyond which a point goes", &c.cloud.outlier_deviations},
      {"cloud.down_sampling", "", "voxel-grid down-sampling", &c.cloud.down_sampling},
      {"cloud.down_sampling_leaf", "m", "edge of its voxels", &c.cloud.down_sampling_leaf},
      {"map.resolution", "m", "voxel edge", &c.map.resolution},
      {"map.region_edge", "m", "edge of the region of interest around the object", &c.map.region_edge},
      {"map.insertion", "", "register a local octree, or insert directly: the same map",
       choice(c.map.insertion, {"local-octree", "direct"})},
      {"map.hit", "", "inverse sensor model: P(occupied | a ray ended here)", &m.hit},
      {"map.miss", "", "inverse sensor model: P(occupied | a ray passed)", &m.miss},
      {"map.hit_decay", "1/m", "a hit's log-odds are those of map.hit at 1 m, times exp(-this * (range - 1 m))",
       &m.hit_decay},
      {"map.miss_decay", "1/m", "a miss's log-odds likewise, those of map.miss at 1 m", &m.miss_decay},
      {"map.clamp_min", "", "lowest probability", &m.clamp_min},
      {"map.clamp_max", "", "highest probability", &m.clamp_max},
      {"map.occupancy_threshold", "", "from here on a measured voxel stops a ray", &m.occupancy_threshold},
      {"map.free_below", "", "class free", &m.free_below},
      {"map.occupied_above", "", "class occupied", &m.occupied_above},
      {"gibbs.model", "", "forward sensor model", choice(g.model.kind, {"paper", "cone", "beam", "attenuation"})},
      {"gibbs.voxel_range", "", "range of a voxel: over the ray's segment in it, or its centre's",
       choice(g.model.voxel_range, {"segment", "centre"})},
      {"gibbs.sigma", "m", "standard deviation of ranges; 0: the sensor's noise, at least a tenth of a voxel",
       &c.gibbs.sigma},
      {"gibbs.angular_sigma", "rad", "model cone: of azimuth and altitude; 0: half the angular pitch of the rays",
       &c.gibbs.angular_sigma},
      {"gibbs.random_weight", "", "beam, attenuation: share of ranges that come from anywhere", &g.model.random_weight},
      {"gibbs.max_weight", "", "beam, attenuation: share of rays that miss a surface they met", &g.model.max_weight},
      {"gibbs.eta_hit", "", "paper: weight inside the exponent of Eq. 1", &g.model.eta_hit},
      {"gibbs.attenuations", "", "attenuation: of each level, per voxel edge", &c.gibbs.attenuations},
      {"gibbs.prior", "", "of a voxel being occupied (at any level but free)", &g.prior},
      {"gibbs.sampler", "", "draw from the full conditional, or Algorithm 1 as printed",
       choice(g.sampler, {"exact", "algorithm1"})},
      {"gibbs.updated", "", "voxels that are updated", choice(g.updated, {"occupied-and-free", "occupied"})},
      {"gibbs.start", "", "map that the chains start from", choice(g.start, {"octree", "free", "occupied", "random"})},
      {"gibbs.swaps", "", "passes of neighbour swaps a sweep", &g.swaps},
      {"gibbs.plaquettes", "", "passes of 2 x 2 plaquettes a sweep", &g.plaquettes},
      {"gibbs.chains", "", "independent chains, a thread each", &g.chains},
      {"gibbs.sweeps", "", "sweeps of each chain, at most", &g.sweeps},
      {"gibbs.burn_in", "", "sweeps before the first mean that is tried", &g.burn_in},
      {"gibbs.until_stationary", "", "stop as soon as the chains are stationary", &g.until_stationary},
      {"gibbs.view_sweeps", "", "gain gibbs: sweeps after each view, from the last view's on; 0: until stationary",
       &c.gibbs.view_sweeps},
      {"gibbs.ray_spacing", "", "rays nearer to each other than this are joined [voxel edges]; 0: none",
       &g.ray_spacing},
      {"views.layout", "", "how candidate views are laid out",
       choice(c.views.layout, {"hemisphere", "sphere", "rings", "fibonacci", "file"})},
      {"views.count", "", "number of candidate views", &c.views.count},
      {"views.radius", "m", "their distance from the object's centre", &c.views.radius},
      {"views.rings", "", "number of rings (layout rings)", &c.views.rings},
      {"views.file", "", "views file (layout file): a count, then x y z qx qy qz qw a line", &c.views.file},
      {"planner.gain", "", "what ranks the candidate views", gain_choice(c.planner.gain)},
      {"planner.semantics", "", "published, or what the reference code computes",
       choice(c.planner.semantics, {"published", "reference"})},
      {"planner.gain_weight", "", "weight of the gain in the utility (Eq. 13)", &c.planner.weights.gain},
      {"planner.cost_weight", "", "weight of the distance in the utility (Eq. 13)", &c.planner.weights.cost},
      {"planner.combined_weights", "", "gain=weight,…; empty: the pre-release weights, unconfirmed",
       &c.planner.combined_weights},
      {"planner.ray_columns", "", "rays that score a view, across", &c.planner.ray_columns},
      {"planner.ray_rows", "", "rays that score a view, down", &c.planner.ray_rows},
      {"planner.ray_length", "m", "how far they reach", &c.planner.ray_length},
      {"planner.start_azimuth", "deg", "start view, seen from the object", &c.planner.start_azimuth},
      {"planner.start_elevation", "deg", "start view, seen from the object", &c.planner.start_elevation},
      {"termination.views", "", "stop after this many views", &c.termination.views},
      {"termination.coverage", "", "stop at this share of the visible surface; 0: off", &c.termination.coverage},
      {"termination.gain", "", "stop when the best gain falls to this share of the first; 0: off", &c.termination.gain},
      {"termination.new_voxels", "", "stop when a view measures less than this share of the region anew; 0: off",
       &c.termination.new_voxels},
      {"termination.entropy_slope", "", "stop when a view lowers the entropy by less than this share; 0: off",
       &c.termination.entropy_slope},
      {"evaluation.enabled", "", "compare with the mesh after each view", &c.evaluation.enabled},
      {"evaluation.d_reg", "m", "registration distance of surface coverage", &c.evaluation.d_reg},
      {"evaluation.surface_samples", "", "points spread over the true surface", &c.evaluation.surface_samples},
      {"history.memory", "GiB", "that the maps of earlier views may take; older ones are made again from the scans",
       &c.history.memory},
  };
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const auto distance = [](const std::string& a, const std::string& b) {  // Levenshtein
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= b.size(); ++j) {
        const std::size_t above = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
        diagonal = above;
      }
    }
    return row.back();
  };
  return *std::min_element(known.begin(), known.end(),
                           [&](const auto& a, const auto& b) { return distance(word, a) < distance(word, b); });
}

}  // namespace nextview
