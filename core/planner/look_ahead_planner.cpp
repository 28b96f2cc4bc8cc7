#include "core/planner/look_ahead_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planner/new_surface_policy.hpp"
#include "core/progress/stopped.hpp"
#include "core/setting/area_text.hpp"

namespace nextview {
namespace {

constexpr std::size_t arms = 6;      // of a node
constexpr double way_weight = 3.0;   // of the way in a plan's price, over its weight in the utility
constexpr double worth_it = 1.02;    // times the value of the greedy choice's plan, for another to be taken
constexpr double exploration = 0.5;  // against the range of the values so far

/// What is seen after some views, in each world.
struct Fork {
  std::vector<DrawnWorld::Samples> seen;
  ViewSequence so_far;
  double price = 0.0;
};

/// One of the views that may come next.
struct Step {
  std::size_t view;
  double area, price, value;
};

struct Node {
  std::vector<Step> steps;                 ///< the most valuable first
  std::vector<std::size_t> children = {};  ///< of the steps tried out so far: numbers of nodes
  double sum = 0.0;                        ///< of the values of the sequences through it
  int visits = 0;
};

class Search {
 public:
  explicit Search(const ViewTree& tree) : tree_(tree) {
    double by_rays = 0.0, in_worlds = 0.0;
    root_.seen.resize(tree.worlds.size());
    for (std::size_t v = 0; v < tree.gains.size(); ++v) {
      by_rays += tree.gains[v];
      in_worlds += area(root_, v);
    }
    scale_ = in_worlds > 0.0 ? by_rays / in_worlds : 0.0;
    nodes_.push_back({next_steps(root_)});
    std::vector<Step>& steps = nodes_[0].steps;  // what is best one step ahead comes first: it is compared with
    std::erase_if(steps, [&](const Step& s) { return s.view == tree.ranked; });
    if (steps.size() == arms) steps.pop_back();
    steps.insert(steps.begin(), step(root_, tree.ranked));
    best_.resize(steps.size());
  }

  /// Tries out one sequence.
  void simulate() {
    Fork fork = root_;
    std::vector<std::size_t> path = {0}, taken;
    bool is_new = false;
    while (!is_new && fork.so_far.views.size() < tree_.depth && !nodes_[path.back()].steps.empty()) {
      const std::size_t k = select(nodes_[path.back()]);
      taken.push_back(k);
      take(fork, nodes_[path.back()].steps[k]);
      is_new = k == nodes_[path.back()].children.size();
      if (is_new) {
        nodes_[path.back()].children.push_back(nodes_.size());
        nodes_.push_back({next_steps(fork)});
      }
      path.push_back(nodes_[path.back()].children[k]);
    }
    complete(fork, nodes_[path.back()].steps);
    ViewSequence& best = best_[taken.front()];
    if (best.views.empty() || fork.so_far.value > best.value) best = fork.so_far;
    largest_ = std::max(largest_, fork.so_far.value);
    smallest_ = std::min(smallest_, fork.so_far.value);
    for (const std::size_t node : path) nodes_[node].sum += fork.so_far.value, ++nodes_[node].visits;
  }

  LookAhead found() const {
    const Node& root = nodes_[0];
    LookAhead found;
    for (std::size_t k = 0; k < root.children.size(); ++k) {
      if (root.steps[k].view == tree_.ranked) found.of_ranked = best_[k];
      if (found.best.views.empty() || best_[k].value > found.best.value) found.best = best_[k];
    }
    return found;
  }

 private:
  /// What a view would show that is not seen yet: the mean over the worlds [cm^2].
  double area(const Fork& fork, std::size_t view) const {
    double sum = 0.0;
    for (std::size_t w = 0; w < tree_.worlds.size(); ++w)
      sum += tree_.worlds[w].area * double((tree_.worlds[w].seen[view] & ~fork.seen[w]).count());
    return sum / double(tree_.worlds.size());
  }
  Step step(const Fork& fork, std::size_t view) const {
    const auto& views = fork.so_far.views;
    const double shown = views.empty() ? tree_.gains[view] : scale_ * area(fork, view);
    const double price = fork.price + tree_.prices[views.empty() ? tree_.gains.size() : views.back()][view];
    return {view, shown, price, shown * std::pow(tree_.kept, price)};
  }
  std::vector<Step> next_steps(const Fork& fork) const {
    std::vector<Step> steps;
    if (fork.so_far.views.size() >= tree_.depth) return steps;
    for (std::size_t v = 0; v < tree_.gains.size(); ++v)
      if (std::ranges::find(fork.so_far.views, v) == fork.so_far.views.end()) steps.push_back(step(fork, v));
    std::ranges::stable_sort(steps, std::greater(), &Step::value);
    if (steps.size() > arms) steps.resize(arms);
    return steps;
  }
  void take(Fork& fork, const Step& step) const {
    const auto& views = fork.so_far.views;
    fork.so_far.way += tree_.ways[views.empty() ? tree_.gains.size() : views.back()][step.view];
    fork.so_far.area += step.area;
    fork.so_far.value += step.value;
    fork.so_far.views.push_back(step.view);
    fork.price = step.price;
    for (std::size_t w = 0; w < tree_.worlds.size(); ++w) fork.seen[w] |= tree_.worlds[w].seen[step.view];
  }
  /// The best step again and again.
  void complete(Fork& fork, std::vector<Step> steps) const {
    while (!steps.empty()) {
      take(fork, steps.front());
      steps = next_steps(fork);
    }
  }
  /// UCB1 among the steps tried out, or the next one that was not.
  std::size_t select(const Node& node) const {
    if (node.children.size() < node.steps.size()) return node.children.size();
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < node.children.size(); ++k) {
      const Node& child = nodes_[node.children[k]];
      const double mean = (child.sum / child.visits - smallest_) / std::max(largest_ - smallest_, 1e-12);
      const double bound = mean + exploration * std::sqrt(std::log(double(node.visits)) / child.visits);
      if (bound > most) most = bound, best = k;
    }
    return best;
  }

  const ViewTree& tree_;
  Fork root_;
  double scale_;  ///< worlds promise, over all views, what rays do
  std::vector<Node> nodes_;
  std::vector<ViewSequence> best_;  ///< that was found beginning with each of the root's steps
  double largest_ = 0.0, smallest_ = std::numeric_limits<double>::infinity();
};

/// What a way takes: 1 for a view after the mean way from here, in the utility's own terms.
class Price {
 public:
  Price(const Utility& utility, std::span<const Candidate> candidates) {
    double count = 0.0, way = 0.0, seconds = 0.0;
    for (const Candidate& c : candidates)
      if (c.available) count += 1.0, way += c.cost, seconds += c.seconds;
    of_view_ = utility.scan_seconds ? *utility.scan_seconds : utility.weights.gain;
    const double of_mean_way = utility.scan_seconds ? seconds / count : way_weight * utility.weights.cost;
    if (way > 0.0) of_metre_ = of_mean_way * count / way;
    if (const double whole = of_view_ + of_mean_way; whole > 0.0) of_view_ /= whole, of_metre_ /= whole;
  }
  double operator()(double way) const { return of_view_ + of_metre_ * way; }

 private:
  double of_view_, of_metre_ = 0.0;
};

ViewTree view_tree(const PlanningState& state, std::span<const Candidate> candidates, const Utility& utility,
                   std::span<const std::size_t> available) {
  ViewTree tree;
  const auto position = [&](std::size_t v) { return state.candidates[v].T_world_camera.translation(); };
  for (const std::size_t from : available) {
    std::vector<double>& ways = tree.ways.emplace_back();
    for (const std::size_t v : available) ways.push_back((position(v) - position(from)).norm());
  }
  std::vector<double>& from_here = tree.ways.emplace_back();
  for (const std::size_t v : available) {
    tree.gains.push_back(candidates[v].gain);
    from_here.push_back(candidates[v].cost);
  }
  const Price price(utility, candidates);
  tree.prices = tree.ways;
  for (auto& row : tree.prices)
    for (double& way : row) way = price(way);
  return tree;
}

}  // namespace

LookAhead look_ahead(const ViewTree& tree, int simulations, const std::stop_token& stop) {
  Search search(tree);
  for (int i = 0; i < simulations; ++i) {
    throw_if_stopped(stop);
    search.simulate();
  }
  return search.found();
}

OneStepPlanner::Choice LookAheadPlanner::choose(const PlanningState& state, std::span<const Candidate> candidates,
                                                const Utility& utility, std::size_t ranked,
                                                const std::stop_token& stop) const {
  std::vector<std::size_t> available;
  std::vector<Pose> poses;
  for (std::size_t v = 0; v < candidates.size(); ++v) {
    if (!candidates[v].available || candidates[v].overlaps != candidates[ranked].overlaps) continue;
    available.push_back(v);
    poses.push_back(state.candidates[v].T_world_camera);
  }
  ViewTree tree = view_tree(state, candidates, utility, available);
  tree.ranked = std::size_t(std::ranges::find(available, ranked) - available.begin());
  const SurfaceEvidence evidence = surface_evidence(state.known);
  WorldDraws draws;
  draws.ray_length = state.config.ray_length;
  draws.seed = state.seed;
  draws.step = static_cast<std::uint32_t>(state.taken.size());
  tree.worlds = draw_worlds(evidence, {evidence, model_}, poses, state.bundle, draws, stop);
  if (tree.worlds.empty()) return {ranked};
  const LookAhead found = look_ahead(tree, simulations_, stop);
  const std::size_t first = available[found.best.views.front()];
  if (first == ranked || found.best.value < worth_it * found.of_ranked.value) return {ranked};
  return {first, fmt::format(" {} views that begin here promise {} in {:.1f} m; after {}, {} in {:.1f} m.",
                             found.best.views.size(), area_text(found.best.area), found.best.way, ranked,
                             area_text(found.of_ranked.area), found.of_ranked.way)};
}

std::unique_ptr<Planner> make_planner(const PlannerConfig& config) {
  auto policy = make_policy(config);
  if (config.simulations == 0) return std::make_unique<OneStepPlanner>(std::move(policy));
  return std::make_unique<LookAheadPlanner>(std::move(policy), config.new_surface, config.simulations);
}

}  // namespace nextview
