#include "outcome_cells.h"

#include <algorithm>

#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// Returns `sums` together with `weight` steps that find the mean of `prior`.
OutcomeSums with_prior(OutcomeSums sums, OutcomeSums prior, double weight) {
  if (!(prior.weight > 0)) return sums;
  prior.scale(weight / prior.weight);
  return sums += prior;
}

ExpectedOutcome expected(const OutcomeSums& sums) {
  if (!(sums.weight > 0)) return {};
  return {static_cast<float>(sums.radiance / sums.weight),
          static_cast<float>(sums.squared / sums.weight),
          static_cast<float>(std::max(sums.cost / sums.weight, 1.0))};
}

}  // namespace

OutcomeSums& OutcomeSums::operator+=(const OutcomeSums& other) {
  weight += other.weight;
  radiance += other.radiance;
  squared += other.squared;
  cost += other.cost;
  return *this;
}

void OutcomeSums::scale(double factor) {
  weight *= factor;
  radiance *= factor;
  squared *= factor;
  cost *= factor;
}

void OutcomeSums::archive(Archive& archive) {
  archive(weight, radiance, squared, cost);
  archive.expect(weight >= 0 && radiance >= 0 && squared >= 0 && cost >= 0,
                 "what was learned of steps");
}

std::size_t DirectionBins::at(Vec3 direction) const {
  const Vec2 u = warp::square_from_sphere(direction);
  const auto bin = [](float x, std::uint32_t bins) {
    const auto i = static_cast<std::int64_t>(x * static_cast<float>(bins));
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, bins - 1));
  };
  return bin(u.x, rows_) * 2 * rows_ + bin(u.y, 2 * rows_);
}

void OutcomeCell::forget(double factor) {
  for (OutcomeSums& bin : bins) bin.scale(factor);
}

void OutcomeCell::learn(std::span<const StepOutcome> outcomes, const DirectionBins& directions) {
  if (outcomes.empty()) return;
  bins.resize(directions.count());
  for (const StepOutcome& outcome : outcomes)
    bins[directions.at(outcome.towards_viewer)].add(outcome);
}

OutcomeSums OutcomeCell::sum() const {
  OutcomeSums sum;
  for (const OutcomeSums& bin : bins) sum += bin;
  return sum;
}

OutcomeField::OutcomeField(const OutcomeCells& cells, DirectionBins directions, double prior)
    : tree_(cells.tree()), directions_(directions) {
  OutcomeSums scene;
  for (std::size_t i = 0; i < cells.size(); ++i) scene += cells[i].sum();
  expected_.reserve(cells.size() * directions.count());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const OutcomeSums cell = with_prior(cells[i].sum(), scene, prior);
    for (std::size_t bin = 0; bin < directions.count(); ++bin) {
      const OutcomeSums own = cells[i].knows_something() ? cells[i].bins[bin] : OutcomeSums{};
      expected_.push_back(expected(with_prior(own, cell, prior)));
    }
  }
}

void OutcomeField::archive(Archive& archive) {
  archive(tree_, expected_);
  bool is_sound = expected_.size() == tree_.cell_count() * directions_.count();
  for (const ExpectedOutcome& e : expected_) {
    is_sound &= e.radiance >= 0 && e.squared >= 0 && e.cost >= 1;
  }
  archive.expect(is_sound, "what was learned of steps");
}

}  // namespace pharos
