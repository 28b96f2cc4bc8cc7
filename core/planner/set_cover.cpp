#include "core/planner/set_cover.hpp"

#include <CbcModel.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace nextview {
namespace {

/// "All that is left is at least as much as these views must add": sum of shares x >= 1, x a 0 or 1 for each view.
struct Cut {
  std::vector<int> views;
  std::vector<double> shares;

  double at(std::span<const double> x) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < views.size(); ++i) sum += shares[i] * x[std::size_t(views[i])];
    return sum;
  }
};

/// What is to be covered, elements that all views cover alike taken together.
class Elements {
 public:
  Elements(std::span<const std::vector<Covered>> views, double left) : view_count_(views.size()) {
    std::vector<std::vector<By>> of_element;
    for (std::uint32_t v = 0; v < views.size(); ++v)
      for (const Covered& covered : views[v]) {
        if (!(covered.amount > 0.0f)) continue;
        if (covered.element >= of_element.size()) of_element.resize(covered.element + 1);
        of_element[covered.element].emplace_back(-covered.amount, v);
      }
    std::map<std::vector<By>, double> alike;
    for (auto& by : of_element) {
      std::ranges::sort(by);
      if (!by.empty()) alike[std::move(by)] += 1.0;
    }
    for (const auto& [by, count] : alike) {
      elements_.push_back({count, by});
      all_ -= count * by.front().first;
    }
    tolerance_ = 1e-9 * all_;
    left_ = std::max(0.0, left) + tolerance_;
  }

  std::size_t view_count() const { return view_count_; }

  bool is_enough(std::span<const double> x) const {
    double open = all_;
    for (const Element& element : elements_)
      for (const auto& [amount, view] : element.by)
        if (x[view] > 0.5) {
          open += element.count * amount;
          break;
        }
    return open <= left_;
  }

  /// Takes the view that adds most of those with x = 1, again and again.
  std::vector<std::size_t> greedy(std::span<const double> x) const {
    std::vector<std::size_t> chosen;
    std::vector<float> covered(elements_.size(), 0.0f);
    for (double open = all_; open > left_;) {
      std::vector<double> adds(view_count_, 0.0);
      for (std::size_t e = 0; e < elements_.size(); ++e)
        for (const auto& [amount, view] : elements_[e].by) {
          if (-amount <= covered[e]) break;
          if (x[view] > 0.5) adds[view] += elements_[e].count * (double(-amount) - covered[e]);
        }
      const auto best = std::ranges::max_element(adds);
      if (best == adds.end() || !(*best > tolerance_)) break;  // but for rounding, nothing is left
      open -= *best;
      chosen.push_back(std::size_t(best - adds.begin()));
      for (std::size_t e = 0; e < elements_.size(); ++e)
        for (const auto& [amount, view] : elements_[e].by)
          if (view == chosen.back()) covered[e] = std::max(covered[e], -amount);
    }
    return chosen;
  }

  /// What holds of all covers, and not of x if x leaves too much. Of an element that views cover by amounts a1 >= a2 >=
  /// ..., with x1 + ... + xk the first such sum from 1 on, a set covers no more than ak + sum of (ai - ak) over its
  /// views before k. (Of x between 0 and 1 that is what Benders' decomposition of facility location has.)
  std::optional<Cut> cut(std::span<const double> x) const {
    std::vector<double> adds(view_count_, 0.0);
    double open = all_;
    for (const Element& element : elements_) {
      double sum = 0.0;
      auto reached = element.by.begin();
      while (reached != element.by.end() && (sum += x[reached->second]) < 1.0 - 1e-9) ++reached;
      const double sure = reached == element.by.end() ? 0.0 : -reached->first;
      open -= element.count * sure;
      for (auto by = element.by.begin(); by != reached; ++by) adds[by->second] += element.count * (-by->first - sure);
    }
    const double needed = open - left_;
    if (!(needed > 0.0)) return std::nullopt;
    Cut cut;
    for (std::size_t v = 0; v < view_count_; ++v)
      if (adds[v] > 0.0) {
        cut.views.push_back(int(v));
        cut.shares.push_back(std::min(1.0, adds[v] / needed));  // as x is whole, more than all counts as all
      }
    return cut;
  }

 private:
  using By = std::pair<float, std::uint32_t>;  ///< less what the view covers, view: sorted, the largest comes first
  struct Element {
    double count;  ///< of elements alike
    std::vector<By> by;
  };

  std::size_t view_count_;
  std::vector<Element> elements_;
  double all_ = 0.0, left_ = 0.0, tolerance_ = 0.0;
};

std::vector<double> as_x(std::span<const std::size_t> views, std::size_t count) {
  std::vector<double> x(count, 0.0);
  for (const std::size_t v : views) x[v] = 1.0;
  return x;
}

/// Leaves out those that later ones have made needless.
std::vector<std::size_t> without_needless(const Elements& elements, std::vector<std::size_t> views) {
  std::vector<double> x = as_x(views, elements.view_count());
  for (const std::size_t v : views) {
    x[v] = 0.0;
    if (!elements.is_enough(x)) x[v] = 1.0;
  }
  std::erase_if(views, [&](std::size_t v) { return x[v] == 0.0; });
  return views;
}

/// The fewest views, as far as its cuts know what is to be covered.
class Relaxation {
 public:
  explicit Relaxation(const Elements& elements) : elements_(elements) {
    solver_.messageHandler()->setLogLevel(0);
    for (std::size_t v = 0; v < elements.view_count(); ++v) {
      solver_.addCol(0, nullptr, nullptr, 0.0, 1.0, 1.0);
      solver_.setInteger(int(v));
    }
  }

  /// Cuts off fractions until the least sum of fractions needs as many views as `most`, or no more is cut off. True if
  /// it does, as then no fewer cover enough.
  bool needs(std::size_t most, int cuts) {
    constexpr int kept = 40;
    constexpr double hardly = 1e-4;
    for (int round = 0; round < cuts; ++round) {
      solver_.resolve();
      if (!solver_.isProvenOptimal()) return false;
      if (solver_.getObjValue() > double(most) - 1.0 + 1e-6) return true;
      const std::span x(solver_.getColSolution(), elements_.view_count());
      const auto cut = elements_.cut(x);
      if (!cut || cut->at(x) > 1.0 - hardly) return false;
      if (solver_.getNumRows() > kept) forget_idle();
      add(*cut);
    }
    return false;
  }

  void allow(std::size_t most) {
    std::vector<int> all(elements_.view_count());
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = int(v);
    const std::vector<double> ones(all.size(), 1.0);
    solver_.addRow(int(all.size()), all.data(), ones.data(), 0.0, double(most));
  }

  struct Found {
    bool is_proven = false;  ///< least, or that there is none
    std::vector<std::size_t> views;
  };
  /// Of whole numbers. Takes what it uses off `nodes`.
  Found fewest(int& nodes) const {
    CbcModel model(solver_);
    model.setLogLevel(0);
    model.solver()->messageHandler()->setLogLevel(0);
    model.setMaximumNodes(nodes);
    model.branchAndBound();
    nodes -= std::max(1, model.getNodeCount());
    Found found{model.isProvenOptimal() || model.isProvenInfeasible(), {}};
    if (const double* x = model.bestSolution())
      for (std::size_t v = 0; v < elements_.view_count(); ++v)
        if (x[v] > 0.5) found.views.push_back(v);
    return found;
  }

  /// These views leave too much; and so do they with as many others as do not help.
  void refuse(std::span<const std::size_t> views) {
    std::vector<double> x = as_x(views, elements_.view_count());
    add_cut(x);
    for (double& one : x) {
      if (one > 0.5) continue;
      one = 1.0;
      if (elements_.is_enough(x)) one = 0.0;
    }
    add_cut(x);
  }

 private:
  /// Cuts that do not bind where the sum is least: they would cost more than they are worth.
  void forget_idle() {
    std::vector<int> idle;
    for (int row = 0; row < solver_.getNumRows(); ++row)
      if (solver_.getRowActivity()[row] > solver_.getRowLower()[row] + 1e-6) idle.push_back(row);
    solver_.deleteRows(int(idle.size()), idle.data());
  }
  void add_cut(std::span<const double> x) {
    if (const auto cut = elements_.cut(x)) add(*cut);
  }
  void add(const Cut& cut) {
    solver_.addRow(int(cut.views.size()), cut.views.data(), cut.shares.data(), 1.0 - 1e-7, COIN_DBL_MAX);
  }

  const Elements& elements_;
  OsiClpSolverInterface solver_;
};

}  // namespace

SetCover least_cover(std::span<const std::vector<Covered>> views, double left, const CoverLimits& limits) {
  const Elements elements(views, left);
  SetCover cover;
  cover.views = without_needless(elements, elements.greedy(std::vector<double>(views.size(), 1.0)));
  cover.is_least = cover.views.size() < 2;
  if (cover.is_least || views.size() > limits.views || cover.views.size() > limits.fewest) return cover;
  Relaxation relaxation(elements);
  cover.is_least = relaxation.needs(cover.views.size(), limits.cuts);
  if (cover.is_least) return cover;
  relaxation.allow(cover.views.size() - 1);
  int nodes = limits.nodes;
  for (int round = 0; round < limits.rounds && nodes > 0; ++round) {
    const Relaxation::Found found = relaxation.fewest(nodes);
    if (found.views.empty()) return {cover.views, found.is_proven};
    const std::vector<double> x = as_x(found.views, views.size());
    if (elements.is_enough(x)) return {elements.greedy(x), found.is_proven};
    relaxation.refuse(found.views);
  }
  return cover;
}

}  // namespace nextview
