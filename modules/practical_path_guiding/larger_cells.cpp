#include "larger_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pharos::practical_path_guiding {
namespace {

Sums together(const Sums& a, const Sums& b, const QuadRefinement& rule) {
  Sums sums{a.tree, a.light + b.light, a.squares + b.squares, a.weight + b.weight,
            a.steps + b.steps};
  sums.tree.add(b.tree, 1, true);
  sums.tree = sums.tree.refined(LeafMass::sum, rule, 1);
  return sums;
}

/// Mixes a cell with a larger one, which counts as `prior` records.
void mix(Sums& cell, const Sums& larger, double prior) {
  if (!(larger.light > 0)) return;
  const double n = cell.effective(), share = prior / (n + prior);
  const double mean = std::lerp(cell.mean(), larger.mean(), share), found = cell.light;
  cell.steps = std::max(cell.steps, 1.0);
  cell.light = mean * cell.steps;
  cell.squares = cell.light * cell.light / (n + std::min(prior, larger.effective()));
  if (found > 0) cell.tree.scale((1 - share) * cell.light / found);
  cell.tree.add(larger.tree, share * cell.light / larger.light, true);
}

}  // namespace

void Sums::scale(double factor) {
  tree.scale(factor);
  light *= factor;
  squares *= factor;
  weight *= factor;
  steps *= factor;
}

std::vector<Sums> with_larger_cells(const std::vector<const Sums*>& own, const Cells& cells,
                                    double prior, const QuadRefinement& rule) {
  const std::vector<std::uint32_t> parents = cells.space.parents(), leaves = cells.space.leaves();
  std::vector<Sums> result;
  result.reserve(own.size());
  for (const Sums* const sums : own) result.push_back(*sums);
  const std::size_t facings = cells.in_each();
  for (std::size_t facing = 0; facing < facings; ++facing) {
    std::vector<std::optional<Sums>> all(parents.size());  // by place in the tree over space
    for (std::size_t cell = 0; cell < leaves.size(); ++cell) {
      all[leaves[cell]] = *own[cell * facings + facing];
    }
    // Parents have lower places than their children.
    for (std::size_t place = parents.size(); place-- > 1;) {
      std::optional<Sums>& parent = all[parents[place]];
      parent = parent ? together(*parent, *all[place], rule) : *all[place];
    }
    for (std::size_t place = 1; place < parents.size(); ++place) {
      mix(*all[place], *all[parents[place]], prior);
      all[place]->tree = all[place]->tree.refined(LeafMass::sum, rule, 1);
    }
    for (std::size_t cell = 0; cell < leaves.size(); ++cell) {
      result[cell * facings + facing] = std::move(*all[leaves[cell]]);
    }
  }
  return result;
}

}  // namespace pharos::practical_path_guiding
