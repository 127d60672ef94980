#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/guiding/toolkit/kd_tree_learning.h>

/// What learners share that keep a mixture in each cell of a kd-tree: settings, and the steps by
/// which a mixture follows its data. A component is whatever the mixture consists of.
namespace pharos {

/// Settings of such a learner. Learners derive their settings from it.
struct MixtureLearningSettings {
  SpatialCells spatial = SpatialCells::kdtree;
  std::uint32_t cell_samples = 32768;
  int max_depth = 32;
  std::uint32_t batch_samples = 1u << 22;
  std::uint32_t components = 16, most_components = 32;
  std::uint32_t first_samples = 32;
  int em_iterations = 100;
  double em_tolerance = 0.005;
  double split_threshold = 0.5;
  float least_density = 0.01f;
  std::uint32_t split_samples = 4096;
  double merge_threshold = 0.025;
  std::uint32_t merge_samples = 8192;
  double decay = 1, division_decay = 0.25;
  float least_pdf = 0.1f;

  /// Throws InputError if a mixture begins with more components than it may have.
  void check() const;
};

/// Declares the parameters of MixtureLearningSettings for settings derived from it.
template <class Settings>
void describe_mixture_learning(Schema<Settings>& s) {
  using S = MixtureLearningSettings;
  s.field("spatial", &S::spatial,
          "A mixture for each cell of a growing tree, or a single one for the whole scene");
  s.field("cell_samples", &S::cell_samples,
          "Samples after which a cell is divided, at their mean across the axis of their largest "
          "variance")
      .at_least(64);
  s.field("max_depth", &S::max_depth, "Most planes above a cell")
      .at_least(0)
      .at_most(KdTree::kMostLevels);
  s.field("batch_samples", &S::batch_samples,
          "Most samples that wait: when there are more, cells learn from them before the iteration "
          "ends")
      .at_least(1024);
  s.field("components", &S::components, "Components of a mixture at first")
      .at_least(1)
      .at_most(1024);
  s.field("most_components", &S::most_components, "Most components of a mixture")
      .at_least(1)
      .at_most(1024);
  s.field("first_samples", &S::first_samples,
          "Samples that found light, before a cell's first mixture is fitted")
      .at_least(2);
  s.field("em_iterations", &S::em_iterations, "Most steps of a fit").at_least(1);
  s.field("em_tolerance", &S::em_tolerance,
          "A fit ends when a step raises its objective, a logarithm, by less than this for each "
          "sample")
      .at_least(0);
  s.field("split_threshold", &S::split_threshold,
          "Chi-square divergence over directions above which a component is split")
      .above(0);
  s.field("least_density", &S::least_density,
          "Lower bound of the mixture's density in that divergence, in units of a uniform density: "
          "unguided samples find what the mixture leaves out")
      .at_least(1e-6)
      .at_most(1);
  s.field("split_samples", &S::split_samples,
          "Samples that a component is judged by before it is split")
      .at_least(1);
  s.field("merge_threshold", &S::merge_threshold,
          "Chi-square cost below which two components are merged")
      .at_least(0);
  s.field("merge_samples", &S::merge_samples, "Samples from one merging to the next").at_least(1);
  s.field("decay", &S::decay, "Share of what was learned that is kept for the next iteration")
      .at_least(0)
      .at_most(1);
  s.field("division_decay", &S::division_decay,
          "Share of what was learned that each half keeps when a cell is divided")
      .at_least(0)
      .at_most(1);
  s.field("least_pdf", &S::least_pdf, "Smaller densities of samples count as this one")
      .unit("1/sr")
      .above(0);
}

/// Lets a cell learn from the samples of one iteration: calls `learn(samples)` once there are
/// `enough` samples that found light, and keeps such samples in `first` until then. `is_known`: the
/// cell has a mixture already.
template <class Sample, class Learn>
void learn_when_enough(std::span<const Sample> samples, bool is_known, std::size_t enough,
                       std::vector<Sample>& first, Learn&& learn) {
  const auto finds = [](const Sample& s) { return s.weight > 0; };
  const auto found = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), finds));
  if (found == 0) return;
  if (is_known) {
    learn(samples);
  } else if (first.size() + found < enough) {
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(first), finds);
  } else {
    std::vector<Sample> all = std::exchange(first, {});
    all.insert(all.end(), samples.begin(), samples.end());
    learn(std::span<const Sample>(all));
  }
}

/// Merges the cheapest pair of components as long as its cost is below `threshold`. `size()` is the
/// number of components, `cost(i, j, bound)` the cost of merging i and j > i, of which only matters
/// whether it is below `bound`, and `join(i, j)` merges j into i.
template <class Size, class Cost, class Join>
void merge_cheapest_pairs(double threshold, Size&& size, Cost&& cost, Join&& join) {
  while (size() > 1) {
    std::size_t best_i = 0, best_j = 0;
    double least = threshold;
    for (std::size_t i = 0; i < size(); ++i) {
      for (std::size_t j = i + 1; j < size(); ++j) {
        const double own = cost(i, j, least);
        if (own < least) std::tie(least, best_i, best_j) = std::tuple(own, i, j);
      }
    }
    if (best_j == 0) return;
    join(best_i, best_j);
  }
}

/// Halves the components whose divergence is above `threshold`, the worst first, while there are
/// fewer than `most`. `halve(k)` adds the other half at the end; it returns false if k cannot be
/// halved. Returns the numbers of all halves in ascending order.
template <class Size, class Divergence, class Halve>
std::vector<std::size_t> halve_worst(double threshold, std::size_t most, Size&& size,
                                     Divergence&& divergence, Halve&& halve) {
  std::vector<std::size_t> worst;
  for (std::size_t k = 0; k < size(); ++k) {
    if (divergence(k) > threshold) worst.push_back(k);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [&](std::size_t a, std::size_t b) { return divergence(a) > divergence(b); });
  std::vector<std::size_t> changed;
  for (const std::size_t k : worst) {
    if (size() >= most) break;
    if (!halve(k)) continue;
    changed.push_back(k);
    changed.push_back(size() - 1);
  }
  std::sort(changed.begin(), changed.end());
  return changed;
}

/// Splits components that the samples contradict and fits their halves, until none is left or there
/// is no room or no data for more. `assess()` compares every component with the samples,
/// `split()` is halve_worst(), `fit(changed)` fits the halves, and `renew(k, assessment)` replaces
/// what was known about half k.
template <class Assess, class Split, class Fit, class Renew>
void split_until_settled(Assess&& assess, Split&& split, Fit&& fit, Renew&& renew) {
  std::vector<std::size_t> changed = split();
  while (!changed.empty()) {
    fit(changed);
    const auto again = assess();
    for (const std::size_t k : changed) renew(k, again[k]);
    changed = split();
  }
}

}  // namespace pharos
