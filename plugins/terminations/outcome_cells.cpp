#include "outcome_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pharos {
namespace {

/// Returns the number as a float, the largest one if it is larger.
float as_float(double number) {
  return static_cast<float>(std::min(number, double{std::numeric_limits<float>::max()}));
}

/// Returns the spread of estimates with these means.
Spread spread(const OutcomeMoments& mean) {
  const double variance = std::max(mean.limited_squared - mean.limited * mean.limited, 0.0);
  const double cost = std::max(mean.cost, 1.0);
  return {as_float(std::sqrt(mean.squared / cost)), as_float(std::sqrt(variance / cost))};
}

/// Returns the expected values for the means of a step and of a light sample.
ExpectedOutcome expected(const OutcomeSums& mean) {
  return {as_float(mean.steps.radiance + mean.lights.radiance), spread(mean.steps),
          spread(mean.lights)};
}

/// Returns what was found below each plane and in each cell of the tree, by place and bin.
std::vector<OutcomeSums> sums_by_place(const OutcomeCells& cells, std::size_t bins) {
  const std::vector<std::uint32_t> leaves = cells.tree().leaves(), parents = cells.tree().parents();
  std::vector<OutcomeSums> sums(parents.size() * bins);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::copy(cells[i].bins.begin(), cells[i].bins.end(), sums.begin() + leaves[i] * bins);
  }
  for (std::size_t place = parents.size(); place-- > 1;) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      sums[parents[place] * bins + bin] += sums[place * bins + bin];
    }
  }
  return sums;
}

/// Returns the means of the sums; zero if there is nothing.
OutcomeMoments mean_of(OutcomeMoments sums) {
  if (sums.count > 0) sums.scale(1 / sums.count);
  return sums;
}

/// Returns the means of `sums` together with `prior_count` outcomes of means `prior`.
OutcomeMoments mean_of(const OutcomeMoments& sums, OutcomeMoments prior, double prior_count) {
  if (!(prior_count + sums.count > 0)) return prior;
  prior.scale(prior_count);
  prior += sums;
  return mean_of(prior);
}

/// Returns the means at each place and in each bin. Each starts from the means of the same bin at
/// the place above, the uppermost one from the means of the scene, as if these were the means of
/// `prior_count` further steps and light samples. So a small cell expects rare light that only a
/// larger cell has found.
std::vector<OutcomeSums> means_by_place(const std::vector<OutcomeSums>& sums,
                                        const std::vector<std::uint32_t>& parents, std::size_t bins,
                                        double prior_count) {
  OutcomeSums all;
  for (std::size_t bin = 0; bin < bins; ++bin) all += sums[bin];
  all = {mean_of(all.steps), mean_of(all.lights)};
  std::vector<OutcomeSums> means(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::size_t place = i / bins, bin = i % bins;
    const OutcomeSums& above = place > 0 ? means[parents[place] * bins + bin] : all;
    means[i] = {mean_of(sums[i].steps, above.steps, prior_count),
                mean_of(sums[i].lights, above.lights, prior_count)};
  }
  return means;
}

}  // namespace

OutcomeMoments& OutcomeMoments::operator+=(const OutcomeMoments& other) {
  count += other.count;
  radiance += other.radiance;
  squared += other.squared;
  cost += other.cost;
  limited += other.limited;
  limited_squared += other.limited_squared;
  return *this;
}

void OutcomeMoments::scale(double factor) {
  count *= factor;
  radiance *= factor;
  squared *= factor;
  cost *= factor;
  limited *= factor;
  limited_squared *= factor;
}

void OutcomeMoments::archive(Archive& archive) {
  archive(count, radiance, squared, cost, limited, limited_squared);
  archive.expect(count >= 0 && radiance >= 0 && squared >= 0 && cost >= 0 && limited >= 0 &&
                     limited_squared >= 0,
                 "what was learned of steps");
}

OutcomeSums& OutcomeSums::operator+=(const OutcomeSums& other) {
  steps += other.steps;
  lights += other.lights;
  return *this;
}

void OutcomeSums::scale(double factor) {
  steps.scale(factor);
  lights.scale(factor);
}

std::size_t DirectionBins::at(Vec3 direction) const {
  // Along the edges of the square |x| + |y| = 1, from 0 to 4: an azimuth without an arc tangent.
  const float size = std::max(std::abs(direction.x) + std::abs(direction.y), 1e-20f);
  const float t = direction.y / size;
  const float around = direction.x < 0 ? 2 - t : direction.y < 0 ? 4 + t : t;
  const auto bin = [this](float u) {
    const auto i = static_cast<std::int64_t>(u * static_cast<float>(rows_));
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, rows_ - 1));
  };
  return bin(0.5f * direction.z + 0.5f) * rows_ + bin(0.25f * around);
}

void OutcomeCell::forget(double factor) {
  for (OutcomeSums& bin : bins) bin.scale(factor);
}

void OutcomeCell::learn(std::span<const Outcome> outcomes, const DirectionBins& directions) {
  if (outcomes.empty()) return;
  bins.resize(directions.count());
  for (const Outcome& outcome : outcomes) bins[directions.at(outcome.towards_viewer)].add(outcome);
}

OutcomeField::OutcomeField(const OutcomeCells& cells, DirectionBins directions, double least_steps)
    : directions_(directions) {
  const std::size_t bins = directions.count();
  const std::vector<OutcomeSums> sums = sums_by_place(cells, bins);
  const std::vector<std::uint32_t> parents = cells.tree().parents();
  // A plane matters if a bin beside it has enough steps. The tree without the others is smaller, so
  // look-ups take less time.
  std::vector<bool> matters(parents.size(), false);
  for (std::size_t i = bins; i < sums.size(); ++i) {
    if (sums[i].steps.count >= least_steps) matters[parents[i / bins]] = true;
  }
  KdTree::UpperPart used = cells.tree().upper_part(matters);
  const std::vector<OutcomeSums> means = means_by_place(sums, parents, bins, least_steps);
  expected_.reserve(used.places.size() * bins);
  for (const std::uint32_t place : used.places) {
    for (std::size_t bin = 0; bin < bins; ++bin) {
      expected_.push_back(expected(means[place * bins + bin]));
    }
  }
  tree_ = std::move(used.tree);
}

void OutcomeField::archive(Archive& archive) {
  archive(tree_, expected_);
  const auto is_spread = [](Spread s) { return s.squared >= 0 && s.variance >= 0; };
  bool is_sound = expected_.size() == tree_.cell_count() * directions_.count();
  for (const ExpectedOutcome& e : expected_) {
    is_sound &= e.radiance >= 0 && is_spread(e.step) && is_spread(e.light);
  }
  archive.expect(is_sound, "what was learned of steps");
}

}  // namespace pharos
