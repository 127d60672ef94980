#include "larger_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <pharos/core/parallel.h>

namespace pharos::practical_path_guiding {
namespace {

/// Replaces the tree by one that is refined for its values.
void refine(QuadTree& tree, LeafMass kind, const QuadRefinement& rule) {
  QuadTree refined = tree.refined(kind, rule);
  refined.add(tree, 1, false);
  tree = std::move(refined);
}

/// Returns the sums of the records of two cells.
Sums together(Sums a, const Sums& b) {
  a.light += b.light;
  a.squares += b.squares;
  a.weight += b.weight;
  a.steps += b.steps;
  a.tree.add(b.tree, 1, true);
  return a;
}

/// Mixes a cell with a larger one, which counts as `prior` records.
void mix(Sums& cell, const Sums& larger, double prior) {
  if (!(larger.light > 0)) return;
  const double n = cell.effective(), share = prior / (n + prior);
  const double mean = std::lerp(cell.mean(), larger.mean(), prior / (cell.weight + prior));
  const double found = cell.light;
  cell.steps = std::max(cell.steps, 1.0);  // for the mean of a cell without records
  cell.light = mean * cell.steps;
  // The prior is at most as reliable as the records of the larger cell.
  cell.squares = cell.light * cell.light / (n + std::min(prior, larger.effective()));
  if (found > 0) cell.tree.scale((1 - share) * cell.light / found);
  cell.tree.add(larger.tree, share * cell.light / larger.light, true);
}

/// The nodes of a tree over space, with their sums.
class Places {
 public:
  explicit Places(const KdTree& space)
      : parents_(space.parents()), low_children_(parents_.size(), 0), sums_(parents_.size()) {
    for (std::uint32_t place = static_cast<std::uint32_t>(parents_.size()); place-- > 1;) {
      low_children_[parents_[place]] = place;
    }
    const std::vector<int> levels = space.levels();
    by_level_.resize(static_cast<std::size_t>(space.depth()) + 1);
    for (std::uint32_t place = 0; place < levels.size(); ++place) {
      by_level_[static_cast<std::size_t>(levels[place])].push_back(place);
    }
  }
  std::optional<Sums>& operator[](std::uint32_t place) { return sums_[place]; }

  /// Gives each node with children the sums of both.
  void add_up(LeafMass kind, const QuadRefinement& rule) {
    for (std::size_t level = by_level_.size(); level-- > 0;) {
      for_each_in(level, [&](std::uint32_t place) {
        const std::uint32_t low = low_children_[place];
        if (low == 0) return;
        sums_[place] = together(*sums_[low], *sums_[low + 1]);
        refine(sums_[place]->tree, kind, rule);
      });
    }
  }
  /// Mixes each node with the node above it, from the root down.
  void mix_down(double prior, LeafMass kind, const QuadRefinement& rule) {
    for (std::size_t level = 1; level < by_level_.size(); ++level) {
      for_each_in(level, [&](std::uint32_t place) {
        mix(*sums_[place], *sums_[parents_[place]], prior);
        if (low_children_[place] != 0) refine(sums_[place]->tree, kind, rule);
      });
    }
  }

 private:
  template <class Visit>
  void for_each_in(std::size_t level, Visit&& visit) {
    const std::vector<std::uint32_t>& places = by_level_[level];
    parallel_for(places.size(), [&](std::size_t i) { visit(places[i]); });
  }

  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> low_children_;  ///< the next place has the other child; 0: a cell
  std::vector<std::vector<std::uint32_t>> by_level_;
  std::vector<std::optional<Sums>> sums_;
};

}  // namespace

void Sums::scale(double factor) {
  tree.scale(factor);
  light *= factor;
  squares *= factor;
  weight *= factor;
  steps *= factor;
}

void Sums::archive(Archive& archive) {
  archive(tree, light, squares, weight, steps);
  archive.expect(light >= 0 && squares >= 0 && weight >= 0 && steps >= 0, "the sums of a cell");
}

std::vector<Sums> with_larger_cells(const std::vector<const Sums*>& own, const Cells& cells,
                                    double prior, LeafMass kind, const QuadRefinement& rule) {
  const std::vector<std::uint32_t> leaves = cells.space.leaves();
  const std::size_t facings = cells.in_each();
  std::vector<Places> of_facings(facings, Places(cells.space));
  for (std::size_t facing = 0; facing < facings; ++facing) {
    Places& places = of_facings[facing];
    for (std::size_t cell = 0; cell < leaves.size(); ++cell) {
      places[leaves[cell]] = *own[cell * facings + facing];
    }
    places.add_up(kind, rule);
    places.mix_down(prior, kind, rule);
  }
  std::vector<Sums> mixed;
  mixed.reserve(own.size());
  for (const std::uint32_t leaf : leaves) {
    for (Places& places : of_facings) mixed.push_back(*std::move(places[leaf]));
  }
  return mixed;
}

}  // namespace pharos::practical_path_guiding
