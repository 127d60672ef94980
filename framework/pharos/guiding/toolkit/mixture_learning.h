#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/guiding/toolkit/kd_tree_learning.h>

/// Code that is shared by learners that keep a mixture in each cell of a kd-tree: their settings,
/// and the steps that adapt a mixture to its data. The steps work for any kind of mixture
/// component.
namespace pharos {

/// Settings of a learner that keeps a mixture in each cell. Learners derive their settings from
/// this class.
struct MixtureLearningSettings {
  SpatialCells spatial = SpatialCells::kdtree;
  std::uint32_t cell_samples = 32768;
  int max_depth = 32;
  std::uint32_t batch_samples = 1u << 22;
  std::uint32_t components = 16, most_components = 32;
  std::uint32_t first_samples = 32, fit_samples = 2048;
  int em_iterations = 100;
  double em_tolerance = 0.005;
  double split_threshold = 0.5;
  float least_density = 0.01f;
  std::uint32_t split_samples = 4096;
  double merge_threshold = 0.025;
  std::uint32_t merge_samples = 8192;
  double decay = 1, division_decay = 0.25;
  bool splat = false;
  float least_pdf = 0.1f;

  /// Throws InputError if `components` is larger than `most_components`.
  void check() const;
  /// Returns the number of samples to which a cell fits its mixture, if it has so many: at least 32
  /// for each component.
  std::size_t most_fit_samples() const;
};

/// Declares the parameters of MixtureLearningSettings for settings derived from it.
template <class Settings>
void describe_mixture_learning(Schema<Settings>& s) {
  using S = MixtureLearningSettings;
  s.field("spatial", &S::spatial,
          "One mixture for each cell of a growing tree, or a single one for the whole scene");
  s.field("cell_samples", &S::cell_samples,
          "A cell with more samples is divided at their mean, across the axis of their largest "
          "variance")
      .at_least(64);
  s.field("max_depth", &S::max_depth, "Largest number of planes above a cell")
      .at_least(0)
      .at_most(KdTree::kMostLevels);
  s.field("batch_samples", &S::batch_samples,
          "Number of collected samples from which cells learn at once, before the iteration ends")
      .at_least(1024);
  s.field("components", &S::components, "Initial number of components of a mixture")
      .at_least(1)
      .at_most(1024);
  s.field("most_components", &S::most_components, "Largest number of components of a mixture")
      .at_least(1)
      .at_most(1024);
  s.field("first_samples", &S::first_samples,
          "Number of samples with light that a cell needs before its first mixture is fitted")
      .at_least(2);
  s.field(
       "fit_samples", &S::fit_samples,
       "Number of samples to which a cell fits its mixture, chosen by their weights from the "
       "samples with light, at least 32 for each of `most_components`; only the last step of the "
       "fit uses all samples with light")
      .at_least(64);
  s.field("em_iterations", &S::em_iterations, "Largest number of EM steps of a fit").at_least(1);
  s.field("em_tolerance", &S::em_tolerance,
          "A fit ends when a step raises its objective, a logarithm, by less than this per sample")
      .at_least(0);
  s.field("split_threshold", &S::split_threshold,
          "Chi-square divergence over directions above which a component is split")
      .above(0);
  s.field("least_density", &S::least_density,
          "Lower bound of the mixture's density in the divergence of split_threshold, relative to "
          "a uniform density; unguided samples cover what the mixture leaves out")
      .at_least(1e-6)
      .at_most(1);
  s.field("split_samples", &S::split_samples,
          "Number of samples that a component needs before it can be split")
      .at_least(1);
  s.field("merge_threshold", &S::merge_threshold,
          "Chi-square cost below which two components are merged")
      .at_least(0);
  s.field("merge_samples", &S::merge_samples, "Number of samples between two merge steps")
      .at_least(1);
  s.field("decay", &S::decay, "Share of the learned data that is kept for the next iteration")
      .at_least(0)
      .at_most(1);
  s.field("division_decay", &S::division_decay,
          "Share of the learned data that each half keeps when a cell is divided")
      .at_least(0)
      .at_most(1);
  s.field("splat", &S::splat,
          "Also teach neighbors: each sample goes to the cell at a random point of a box around it "
          "that is as large as its own cell");
  s.field("least_pdf", &S::least_pdf,
          "Lower bound to which smaller densities of samples are raised")
      .unit("1/sr")
      .above(0);
}

/// Calls `learn(samples)` for a cell with its samples of one iteration. A cell without a mixture
/// (`is_known` is false) waits until it has at least `enough` samples that found light; until then,
/// these samples are kept in `first`. Nothing happens if no sample found light.
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

/// Chooses `count` of `size` samples by systematic sampling: the expected weight of a sample stays,
/// and so does the sum of all weights. `weight(i)` returns the weight of sample i, and `choose(i,
/// weight)` takes a chosen sample with its new weight. A sample that is chosen several times is
/// passed once, with the sum of its new weights. `u` is a random number in [0, 1).
template <class Weight, class Choose>
void choose_systematically(std::size_t size, std::size_t count, double u, Weight&& weight,
                           Choose&& choose) {
  double total = 0;
  for (std::size_t i = 0; i < size; ++i) total += weight(i);
  const double share = total / static_cast<double>(count);
  // The sum of the weights so far passes a multiple of `share` for each choice.
  double sum = u, chosen_before = 0;
  for (std::size_t i = 0; i < size; ++i) {
    sum += weight(i) / share;
    const double chosen_now = std::floor(sum);
    if (chosen_now > chosen_before) choose(i, (chosen_now - chosen_before) * share);
    chosen_before = chosen_now;
  }
}

/// Merges the cheapest pair of components as long as its cost is below `threshold`. `size()`
/// returns the number of components. `cost(i, j, bound)` returns the cost of merging i and j > i;
/// if the cost is not below `bound`, its exact value does not matter. `join(i, j)` merges j into i.
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

/// Halves the components whose divergence is above `threshold`, beginning with the largest
/// divergence, as long as there are fewer than `most` components. `halve(k)` appends the other half
/// as the last component; it returns false if k cannot be halved. Returns the numbers of all halves
/// in ascending order.
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

/// Splits components that do not match the samples and fits their halves. Stops when all components
/// match, or when there is no room or too little data for more. `assess()` compares every component
/// with the samples, `split()` is halve_worst(), `fit(changed)` fits the halves, and `renew(k,
/// assessment)` replaces what was known about half k.
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
